#include "camera/parallel_view.h"

#include "camera/screen_window.h"

namespace slant {

ParallelView::ParallelView(const PerspectiveCamera& camera, const Film& film)
    : pixelsPerUnit_(pixelsPerUnit(camera, film, 1)), rasterOrigin_(camera.screenMin.x, -camera.screenMax.y),
      aperture_(camera.aperture), worldFromCamera_(camera.worldFromCamera) {}

CameraSample ParallelView::sample(glm::vec2 raster, glm::vec2 square, float time) const {
    const glm::dmat4 axes = worldFromCamera_.at(double(time));
    const glm::dvec2 place = rasterOrigin_ + glm::dvec2(raster) / pixelsPerUnit_;
    return {{glm::vec3(axes * glm::dvec4(place.x, -place.y, 0, 1)), glm::vec3(axes[2])},
            concentricDisc(square.x, square.y),
            1};
}

glm::dmat4x3 ParallelView::pinholeFromCamera() const {
    glm::dmat4x3 result(0);
    result[0].x = pixelsPerUnit_;
    result[1].y = -pixelsPerUnit_;
    result[3] = glm::dvec3(-pixelsPerUnit_ * rasterOrigin_, 1);
    return result;
}

} // namespace slant
