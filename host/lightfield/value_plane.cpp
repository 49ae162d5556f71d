#include "lightfield/value_plane.h"

#include "lightfield/motion.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

glm::vec3 normalValue(const glm::vec3& n) {
    return std::isfinite(n.x + n.y + n.z) ? 0.5f * n + 0.5f : glm::vec3(0.5f);
}

glm::vec3 forwardValue(const LightField& field, std::size_t sample) {
    if (!field.moves()) return glm::vec3(0);
    const glm::vec2 moved = displacementPx(field, field.samples[sample], field.motion[sample]);
    const glm::vec2 rightUp(moved.x, -moved.y);
    const float k = std::max({0.f, -rightUp.x, -rightUp.y});
    return std::isfinite(rightUp.x + rightUp.y) ? glm::vec3(rightUp + k, k) : glm::vec3(0);
}

glm::vec3 unchecked(const LightField& field, ValuePlane plane, std::size_t sample) {
    const LightFieldSample& s = field.samples[sample];
    const bool hit = !std::isinf(s.w);
    switch (plane) {
    case ValuePlane::radiance:
        return field.radiance[sample];
    case ValuePlane::coverage:
        return glm::vec3(hit ? 1 : 0);
    case ValuePlane::depth:
        return glm::vec3(hit ? s.w : 0);
    case ValuePlane::albedo:
        return field.hasGuides() ? field.albedo[sample] : glm::vec3(0);
    case ValuePlane::normal:
        return normalValue(field.normal.empty() ? glm::vec3(0) : field.normal[sample]);
    case ValuePlane::forward:
        return forwardValue(field, sample);
    case ValuePlane::illumination:
        return field.hasShading() ? field.illumination[sample] : glm::vec3(0);
    case ValuePlane::reflection:
        return field.hasShading() ? field.reflection[sample] : glm::vec3(0);
    case ValuePlane::direct:
        return field.hasShadows() ? field.direct[sample] : glm::vec3(0);
    }
    return glm::vec3(0);
}

} // namespace

glm::vec3 valueOf(const LightField& field, ValuePlane plane, std::size_t sample) {
    const float most = 1e30f; // sums stay finite
    const auto valid = [=](float value) {
        return std::isfinite(value) && value > 0 ? std::min(value, most) : 0.f;
    };
    const glm::vec3 value = unchecked(field, plane, sample);
    return {valid(value.x), valid(value.y), valid(value.z)};
}

} // namespace slant
