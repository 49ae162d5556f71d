// The sample buffers of Lehtinen et al., "Temporal Light Field Reconstruction for Rendering Distribution
// Effects", 2011: format 1.3, a body NAME and a text NAME.header.
//
// Its slope constants C0, C1 are our C1, C2. Of a sample's sixteen numbers, z/w, a, dwdx and dwdy are not
// read, and are written as 0 (a as alpha); alpha is 0 where w is infinite, else 1. What the format lacks,
// FieldMetadata and the place of the frame among the pixels, is in lines "slant:..." after the header's last
// line.
#pragma once
#include "lightfield/field_file.h"

namespace slant {

/// The body's size must match the header to the byte, or to the line in a text. Throws Error(badInput).
FieldFile readTlfr(const std::string& bodyPath, const std::string& headerPath, Monitor& monitor);

/// Body `path` and `path`.header; in a text, numbers are as short as reading the same bits again allows.
/// Albedo, normals, illumination, reflectance and reflection are left out; slopes other than C1/w + C2, and
/// pixels that differ in their number of samples, are an Error(usage).
void writeTlfr(const std::string& path, const LightField& field, const FieldMetadata& details, bool text,
               Monitor& monitor);

} // namespace slant
