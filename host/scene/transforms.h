// The transforms of pbrt's directives in double precision, and the state that they act on.
#pragma once
#include "scene/position.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

namespace slant {

/// Which matrices of a MovingTransform the transform directives change (ActiveTransform).
enum class ActiveTransform { all, start, end };

/// Rotates by `degrees` about `axis` (any length but 0), by the right-hand formula, as in pbrt.
glm::dmat4 rotation(double degrees, const glm::dvec3& axis);

/// pbrt's LookAt: camera space (x right, y up, z forward; left-handed) from world space. Throws
/// Error(badInput) if the camera looks along `up` or at its own place.
glm::dmat4 lookAt(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up,
                  const Position& where);

/// `matrix` with an exact last row 0 0 0 1. Throws Error(badInput) if it is not affine.
glm::dmat4 affine(const glm::dmat4& matrix, const Position& where);

/// Inverse of an affine matrix, again with an exact last row.
glm::dmat4 affineInverse(const glm::dmat4& matrix);

/// Throws Error(badInput) unless it is finite in floats.
void checkFinite(const MovingTransform& transform, const Position& where);
/// Whether it can be inverted at both times.
bool isInvertible(const MovingTransform& transform);
/// Throws Error(badInput) if it cannot.
void checkInvertible(const MovingTransform& transform, const Position& where);

MovingTransform inverse(const MovingTransform& transform);

/// Throws Error(badInput) if the transform becomes singular between its two times.
void checkMotion(const MovingTransform& transform, const Position& where);

/// What the matrices at the times `times` of the scene do while the shutter is open.
MovingTransform overShutter(const MovingTransform& transform, const std::array<double, 2>& times,
                            double shutterOpen, double shutterClose);

} // namespace slant
