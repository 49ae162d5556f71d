// Light fields as files: our native form, deep OpenEXR (deep_exr.h), and the form of Lehtinen et al. 2011
// (tlfr.h). host/lightfield/README.md describes both for those who write them.
#pragma once
#include "base/monitor.h"
#include "lightfield/field_metadata.h"
#include "lightfield/lightfield.h"

#include <span>
#include <string>

namespace slant {

enum class FieldFormat { deepExr, tlfrBinary, tlfrText };

struct FieldFile {
    FieldFormat format = FieldFormat::deepExr;
    LightField field; ///< as it stands in the file: not sanitized
    FieldMetadata details;
};

/// Its name in messages.
std::string_view nameOf(FieldFormat format);

/// The format by the name's extension: .exr, .bin, .txt. Throws Error(usage) for any other.
FieldFormat formatForName(const std::string& path);

/// Reads a file of any of the formats, recognized by content; either of TLFR's two files may be named.
/// Advances the monitor by samples. Throws Error(badInput) for anything but an intact light field.
FieldFile readField(const std::string& path, Monitor& monitor);

/// In the format of the name's extension. Advances the monitor by samples. Throws Error(resources) if it
/// cannot be written.
void writeField(const std::string& path, const LightField& field, const FieldMetadata& details,
                Monitor& monitor);

/// The extent of a field before its samples are read. Throws Error(badInput) unless sizes are within the
/// limits, the frame lies within the bounds, and c1 <= 0 (nearer is smaller) and c2 are finite. It takes one
/// number of samples per pixel for all.
void checkExtent(const FileLocation& location, const LightField& field, const FieldMetadata& details);

/// Like setSampleCounts, but throws Error(badInput) if there are too many samples, or none at all.
void takeSampleCounts(const FileLocation& location, LightField& field, std::span<const std::uint32_t> counts);

/// Lens maps in files: their texels, one after another (shaders/shared/lens_map.h). Throws Error(badInput)
/// for numbers that are none.
LensMap lensMapOf(const FileLocation& location, std::span<const float> numbers);
std::span<const float> numbersOf(const LensMap& map);

/// Make room for the samples of checked extents and for these planes, and for motion of 0; throw
/// Error(resources) where there is none.
void allocateSamples(LightField& field, SamplePlanes planes);
void allocateMotion(LightField& field);

} // namespace slant
