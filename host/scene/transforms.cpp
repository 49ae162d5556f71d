#include "scene/transforms.h"

#include "scene/animated_transform.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace slant {
namespace {

// |determinant| over the product of the column lengths: 1 for a rotation, 0 for a flat transform. Below
// this an inverse in doubles has no correct digits.
constexpr double kFlattest = 1e-13;
constexpr double kAffineTolerance = 1e-6; // exporters write 0.9999999

} // namespace

glm::dmat4 rotation(double degrees, const glm::dvec3& axis) {
    return glm::rotate(glm::dmat4(1), glm::radians(degrees), axis);
}

glm::dmat4 lookAt(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up,
                  const Position& where) {
    const glm::dvec3 forward = glm::normalize(target - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::normalize(up), forward));
    // Zero lengths above make NaN here.
    if (!(glm::dot(right, right) > 0.5))
        throw badInput(where, "LookAt needs a target apart from the eye and an up vector across the view");
    const glm::dvec3 newUp = glm::cross(forward, right);
    return affineInverse(
        glm::dmat4(glm::dvec4(right, 0), glm::dvec4(newUp, 0), glm::dvec4(forward, 0), glm::dvec4(eye, 1)));
}

glm::dmat4 affine(const glm::dmat4& matrix, const Position& where) {
    glm::dmat4 result = matrix;
    for (int column = 0; column < 4; ++column) {
        const double expected = column == 3 ? 1 : 0;
        if (!(std::abs(matrix[column][3] - expected) <= kAffineTolerance))
            throw badInput(where,
                           "this matrix is not an affine transform: its 4th, 8th, 12th and 16th number "
                           "must be 0, 0, 0 and 1");
        result[column][3] = expected;
    }
    return result;
}

glm::dmat4 affineInverse(const glm::dmat4& matrix) {
    const glm::dmat3 linear = glm::inverse(glm::dmat3(matrix));
    glm::dmat4 result(linear);
    result[3] = glm::dvec4(-(linear * glm::dvec3(matrix[3])), 1);
    return result;
}

void checkFinite(const MovingTransform& transform, const Position& where) {
    for (const glm::dmat4& matrix : transform.at)
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                if (!(std::abs(matrix[column][row]) <= std::numeric_limits<float>::max()))
                    throw badInput(where, "the transform here has numbers beyond the range of a float");
}

bool isInvertible(const MovingTransform& transform) {
    for (const glm::dmat4& matrix : transform.at) {
        const glm::dmat3 linear(matrix);
        const double lengths = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
        if (!(std::abs(glm::determinant(linear)) > kFlattest * lengths)) return false;
    }
    return true;
}

void checkInvertible(const MovingTransform& transform, const Position& where) {
    if (!isInvertible(transform))
        throw badInput(where, "the transform here is singular: it cannot be inverted");
}

MovingTransform inverse(const MovingTransform& transform) {
    return {{affineInverse(transform.at[0]), affineInverse(transform.at[1])}};
}

void checkMotion(const MovingTransform& transform, const Position& where) {
    if (!canInterpolate(transform))
        throw badInput(where, "the transform here mirrors at one of StartTime and EndTime, but not at the "
                              "other: it would be singular in between");
}

MovingTransform overShutter(const MovingTransform& transform, const std::array<double, 2>& times,
                            double shutterOpen, double shutterClose) {
    MovingTransform result = transform;
    if (!transform.moves()) return result;
    for (std::size_t i = 0; i < 2; ++i)
        result.times[i] = (times[i] - shutterOpen) / (shutterClose - shutterOpen);
    // All of the motion may be over before, or begin after.
    if (result.times[1] <= 0) return {{transform.at[1], transform.at[1]}};
    if (result.times[0] >= 1) return {{transform.at[0], transform.at[0]}};
    return result;
}

} // namespace slant
