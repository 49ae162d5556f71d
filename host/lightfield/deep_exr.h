// Light fields as deep OpenEXR scanline files, Slant's own form: one deep sample is one sample of the field.
// host/lightfield/README.md lists channels and attributes.
#pragma once
#include "lightfield/field_file.h"

namespace slant {

/// Throws Error(badInput) for anything but an intact file of that kind, and for one that lacks a channel or
/// constant that a light field needs.
FieldFile readDeepExr(const std::string& path, Monitor& monitor);

/// Uncompressed, 32-bit floats; reading gives the same bits again, in every plane of values that the field
/// has.
void writeDeepExr(const std::string& path, const LightField& field, const FieldMetadata& details,
                  Monitor& monitor);

} // namespace slant
