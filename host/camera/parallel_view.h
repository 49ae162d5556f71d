// pbrt-v4's orthographic camera without a lens: all rays run along the viewing axis. With a lens pbrt sends
// all rays from the lens in the middle of the picture, which makes it a thin lens (thin_lens.h).
#pragma once
#include "camera/aperture.h"
#include "camera/camera_sample.h"
#include "camera/disc.h"
#include "camera/slope_model.h"
#include "scene/animated_transform.h"

namespace slant {

class ParallelView {
public:
    /// Throws Error(badInput) for pixels that are not square.
    ParallelView(const PerspectiveCamera& camera, const Film& film);

    CameraSample sample(glm::vec2 raster, glm::vec2 square, float time = 0) const;
    SlopeModel slopeModel() const { return {}; }
    const Aperture& aperture() const { return aperture_; }
    const AnimatedTransform& worldFromCamera() const { return worldFromCamera_; }
    /// (x, y, 1) of a point in camera space, wherever it is: depths don't matter.
    glm::dmat4x3 pinholeFromCamera() const;

private:
    double pixelsPerUnit_;
    glm::dvec2 rasterOrigin_; ///< in camera space, to the right and down
    Aperture aperture_;
    AnimatedTransform worldFromCamera_;
};

} // namespace slant
