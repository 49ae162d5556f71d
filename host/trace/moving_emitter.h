// Emitters of shapes that move: made for the time at which the shutter opens, and taken from there to others.
#pragma once
#include "scene/animated_transform.h"
#include "trace/emitter.h"

namespace slant {

/// How a shape with an area light moves.
class EmitterMotion {
public:
    explicit EmitterMotion(const MovingTransform& worldFromObject);
    /// Takes the world at time 0 to the world at `time`. It never mirrors.
    glm::dmat4 since0(double time) const { return worldFromObject_.at(time) * objectFromWorld0_; }

private:
    AnimatedTransform worldFromObject_;
    glm::dmat4 objectFromWorld0_;
};

/// The emitter after an affine transform. Spheres stay spheres, so they must not be stretched.
Emitter moved(const Emitter& emitter, const glm::dmat4& by);
EmitterQuadric moved(const EmitterQuadric& quadric, const glm::dmat4& by);

} // namespace slant
