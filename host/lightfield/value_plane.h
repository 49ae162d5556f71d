// Values of samples that a picture can show.
#pragma once
#include "lightfield/lightfield.h"

namespace slant {

/// - radiance: as it stands in the field;
/// - coverage: 1 for samples that hit something, else 0;
/// - depth: of those that did, else 0;
/// - albedo; normal, moved to [0, 1] by n / 2 + 1 / 2 (signed again by fromNormalValue);
/// - forward: how far points move on the picture from shutter open to close, in pixels, to the right and
///   upwards, as (right + k, up + k, k) with the least k >= 0 that leaves nothing negative (signed again by
///   fromForwardValue).
///
/// - illumination, reflection, direct: as they stand in the field, 0 where it has none. No picture: for the
/// filter of
///   shading.
///
/// Whatever plane a picture shows, its values are neither negative nor infinite, and those of a plane are of
/// one order of magnitude: the layer map keeps them with a common exponent.
enum class ValuePlane {
    radiance,
    coverage,
    depth,
    albedo,
    normal,
    forward,
    illumination,
    reflection,
    direct
};

/// The value of one sample. Whatever is negative or not finite is 0, and nothing is more than 1e30; albedo
/// and normal of a field without them are those of a sample that hit nothing, and nothing moves in a field
/// without motions.
glm::vec3 valueOf(const LightField& field, ValuePlane plane, std::size_t sample);

inline float fromNormalValue(float value) {
    return 2 * value - 1;
}

/// Of one value, or of a mean.
inline glm::vec2 fromForwardValue(glm::vec3 value) {
    return {value.x - value.z, value.y - value.z};
}

} // namespace slant
