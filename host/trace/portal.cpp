#include "trace/portal.h"

namespace slant {

Portal::Portal(const std::array<glm::vec3, 4>& corners, const FileLocation& where)
    : corner_(corners[0]), edge1_(corners[3] - corners[0]), edge2_(corners[1] - corners[0]) {
    const float tolerance = 1e-3f * glm::length(edge1_ + edge2_);
    const glm::vec3 cross = glm::cross(edge1_, edge2_);
    area_ = glm::length(cross);
    if (!(area_ > 0) || glm::distance(corners[2], corner_ + edge1_ + edge2_) > tolerance ||
        std::abs(glm::dot(edge1_, edge2_)) > tolerance * glm::length(edge1_))
        throw badInput(where, "the four corners of a portal must form a rectangle");
    normal_ = cross / area_;
}

glm::vec3 Portal::sample(glm::vec3 origin, glm::vec2 u) const {
    return glm::normalize(corner_ + u.x * edge1_ + u.y * edge2_ - origin);
}

float Portal::pdf(glm::vec3 origin, glm::vec3 direction) const {
    const float cosine = glm::dot(direction, normal_), height = glm::dot(corner_ - origin, normal_);
    if (!(cosine > 0) || !(height > 0)) return 0;
    const float length = height / cosine;
    const glm::vec3 place = origin + length * direction - corner_;
    const glm::vec2 st(glm::dot(place, edge1_) / glm::dot(edge1_, edge1_),
                       glm::dot(place, edge2_) / glm::dot(edge2_, edge2_));
    if (glm::any(glm::lessThan(st, glm::vec2(0))) || glm::any(glm::greaterThan(st, glm::vec2(1)))) return 0;
    return length * length / (cosine * area_);
}

} // namespace slant
