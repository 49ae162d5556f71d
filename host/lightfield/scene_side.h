// The samples of a field where reconstruction looks for them: on the scene's side of the lens, where the
// points of the scene move along straight lines.
#pragma once
#include "lightfield/value_plane.h"

namespace slant {

/// Through a thin lens the samples stay as they are. Through a compound lens (camera/lens_map.h) they are
/// taken to the scene's side once, with xy and uv there and values as the scene has them, without the lens's
/// irradiance. Samples where the film is dark are disabled (slope = NaN). The field must live on, unchanged.
class SceneSideSamples {
public:
    /// Unless `moved`, samples stay on the film's side, whatever the lens.
    explicit SceneSideSamples(const LightField& field, bool moved = true);

    const LightField& field() const { return field_; }
    std::span<const LightFieldSample> samples() const {
        return moved_.empty() ? std::span(field_.samples) : std::span(moved_);
    }
    /// The area that samples are spread over there, relative to that on the film, less 1: per sample, or
    /// empty for a thin lens, where it is 0.
    std::span<const float> areaExcess() const { return areaExcess_; }
    glm::vec3 value(ValuePlane plane, std::size_t sample) const;

private:
    const LightField& field_;
    // Per sample; empty for a thin lens.
    std::vector<LightFieldSample> moved_;
    std::vector<float> irradiance_, areaExcess_;
};

} // namespace slant
