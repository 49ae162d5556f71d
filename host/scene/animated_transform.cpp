#include "scene/animated_transform.h"

#include <cmath>

namespace slant {
namespace {

/// More than enough for the flattest matrix that a scene may have: each step halves the exponent.
constexpr int kMaxPolarSteps = 100;
constexpr double kPolarTolerance = 1e-15;

/// The rotation of a matrix of positive determinant, by Newton's iteration (Higham 1986, "Computing the polar
/// decomposition").
glm::dmat3 nearestRotation(const glm::dmat3& matrix) {
    // Of unit determinant it converges from any scale.
    glm::dmat3 rotation = matrix / std::cbrt(glm::determinant(matrix));
    for (int step = 0; step < kMaxPolarSteps; ++step) {
        const glm::dmat3 next = 0.5 * (rotation + glm::transpose(glm::inverse(rotation)));
        double change = 0;
        for (int column = 0; column < 3; ++column)
            change = std::max(change, glm::length(next[column] - rotation[column]));
        rotation = next;
        if (change <= kPolarTolerance) break;
    }
    return rotation;
}

} // namespace

AnimatedTransform::Parts AnimatedTransform::partsOf(const glm::dmat4& matrix) {
    const glm::dmat3 linear(matrix);
    const double sign = glm::determinant(linear) < 0 ? -1 : 1;
    const glm::dmat3 rotation = nearestRotation(sign * linear);
    return {glm::dvec3(matrix[3]), glm::normalize(glm::quat_cast(rotation)),
            glm::transpose(rotation) * linear};
}

AnimatedTransform::AnimatedTransform(const MovingTransform& ends) : ends_(ends), moves_(ends.moves()) {
    if (!moves_) return;
    parts_ = {partsOf(ends.at[0]), partsOf(ends.at[1])};
    glm::dquat &from = parts_[0].rotation, &to = parts_[1].rotation;
    if (glm::dot(from, to) < 0) to = -to;
    angle_ = 2 * std::atan2(glm::length(to - from), glm::length(to + from));
}

glm::dmat4 AnimatedTransform::at(double time) const {
    const auto& times = ends_.times;
    if (!moves_ || time <= times[0]) return ends_.at[0];
    if (time >= times[1]) return ends_.at[1];
    const double part = (time - times[0]) / (times[1] - times[0]), rest = 1 - part;
    const auto& [from, to] = parts_;
    glm::dquat rotation = from.rotation;
    if (angle_ > 0)
        rotation =
            glm::normalize(std::sin(rest * angle_) * from.rotation + std::sin(part * angle_) * to.rotation);
    glm::dmat4 result(glm::mat3_cast(rotation) * (rest * from.stretch + part * to.stretch));
    result[3] = glm::dvec4(rest * from.translation + part * to.translation, 1);
    return result;
}

bool canInterpolate(const MovingTransform& ends) {
    const auto mirrors = [&](std::size_t i) { return glm::determinant(glm::dmat3(ends.at[i])) < 0; };
    return mirrors(0) == mirrors(1);
}

} // namespace slant
