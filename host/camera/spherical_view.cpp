#include "camera/spherical_view.h"

#include "camera/disc.h"
#include "image/octahedral.h"

namespace slant {
namespace {

/// Beyond an edge of the square lies what is mirrored along that edge.
glm::vec2 wrapped(glm::vec2 st) {
    for (int axis = 0; axis < 2; ++axis) {
        if (st[axis] >= 0 && st[axis] <= 1) continue;
        st[axis] = st[axis] < 0 ? -st[axis] : 2 - st[axis];
        st[1 - axis] = 1 - st[1 - axis];
    }
    return glm::clamp(st, 0.f, 1.f);
}

} // namespace

CameraSample SphericalView::sample(glm::vec2 raster, glm::vec2 square, float time) const {
    const glm::vec2 st = raster / resolution_;
    glm::vec3 direction;
    if (equalArea_) {
        direction = equalAreaSquareToSphere(wrapped(st));
    } else {
        const float theta = std::numbers::pi_v<float> * st.y, phi = 2 * std::numbers::pi_v<float> * st.x;
        direction = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    }
    const glm::dmat4 axes = worldFromCamera_.at(double(time));
    return {
        {glm::vec3(axes[3]), glm::vec3(glm::dmat3(axes) * glm::dvec3(direction.x, direction.z, direction.y))},
        concentricDisc(square.x, square.y),
        1};
}

} // namespace slant
