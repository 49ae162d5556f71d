// Where a compound lens sends its rays: from film and exit pupil to the scene's side.
//
// On the scene's side rays are straight, whatever the lens does to them. So a ray is described there by where
// it crosses two planes: `uv`, the plane of the entrance pupil, in units of its radius on the axis; and `xy`,
// the plane in focus, in pixels as seen from the pupil's centre. A fixed point at depth w then moves along an
// exact line, of slope C1 / w + C2 as through a thin lens, distortion, aberrations and the wandering of the
// pupil notwithstanding; and xy is near to the raster position, but for these.
//
// On the film's side a ray is given by its raster position and by a place in the unit disc, which stands for
// the pupil as it is seen from there, cat's eye and all, equal areas for equal shares of light. The lens is
// symmetric about its axis, so the map has three variables: film radius, and two for the disc. It is a table,
// the same for all its users, interpolated linearly: aberrations in coarse rings, the rest in fine ones.
// Where the disc is that of the stop, the table also holds the irradiance of the film from each place and how
// far inside all rims its rays stay: beyond the rims they go on as if there were none, so that the values
// between are smooth. Single floats and + - * / sqrt only (shaders/lib/lens_map.glsl).
#pragma once
#include "shared/lens_map.h"

#include <cstddef>
#include <vector>

namespace slant {

class LensMap {
public:
    /// No map: the lens is thin, and xy and uv are what they are.
    LensMap() = default;
    /// From texels as shared/lens_map.h describes them; they have been checked.
    explicit LensMap(std::vector<vec4> texels) : texels_(std::move(texels)) {}

    bool empty() const { return texels_.empty(); }
    const std::vector<vec4>& texels() const { return texels_; }

    /// Whether the unit disc is that of the stop.
    bool ofStop() const { return !empty() && texels_[2].x > 0; }
    /// `lens` in the unit disc.
    SceneRay at(vec2 raster, vec2 lens) const;

private:
    std::vector<vec4> texels_;
};

/// What is wrong with texels that should form a map; nullptr if nothing is.
const char* faultOf(const std::vector<vec4>& texels);

class CompoundLens;

LensMap makeLensMap(const CompoundLens& camera);

} // namespace slant
