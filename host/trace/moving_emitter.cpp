#include "trace/moving_emitter.h"

#include <cmath>

namespace slant {

EmitterMotion::EmitterMotion(const MovingTransform& worldFromObject)
    : worldFromObject_(worldFromObject), objectFromWorld0_(glm::inverse(worldFromObject_.at(0))) {}

Emitter moved(const Emitter& emitter, const glm::dmat4& by) {
    const glm::dmat3 linear(by);
    Emitter e = emitter;
    e.origin = glm::vec3(by * glm::dvec4(emitter.origin, 1));
    e.edge1 = glm::vec3(linear * glm::dvec3(emitter.edge1));
    e.edge2 = glm::vec3(linear * glm::dvec3(emitter.edge2));
    e.twist = glm::vec3(linear * glm::dvec3(emitter.twist));
    e.radius = emitter.radius * float(std::cbrt(std::abs(glm::determinant(linear))));
    if (e.shape != Emitter::Shape::triangle) return e;
    const glm::vec3 cross = glm::cross(e.edge1, e.edge2), across = e.edge2 - e.edge1;
    const float length = glm::length(cross);
    e.area = length / 2;
    e.size2 = std::max({glm::dot(e.edge1, e.edge1), glm::dot(e.edge2, e.edge2), glm::dot(across, across)});
    const bool turned = glm::dot(glm::cross(emitter.edge1, emitter.edge2), emitter.normal) < 0;
    if (length > 0) e.normal = (turned ? -cross : cross) / length;
    return e;
}

EmitterQuadric moved(const EmitterQuadric& quadric, const glm::dmat4& by) {
    EmitterQuadric q = quadric;
    const glm::dmat4 worldFromObject = by * glm::dmat4(quadric.worldFromObject);
    q.worldFromObject = glm::mat4(worldFromObject);
    q.objectFromWorld = glm::mat4(glm::inverse(worldFromObject));
    return q;
}

} // namespace slant
