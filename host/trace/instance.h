// Bodies at their places in the world.
//
// Embree interpolates the transforms of its own moving instances linearly between time steps, so that a ray
// which leaves the exact surface would start inside its stand-in. Moving bodies are user geometries instead:
// Embree searches boxes that move, and a ray that meets one is taken to the body's space by the exact
// transform at the ray's own time. How finely the boxes follow the motion decides about speed alone.
#pragma once
#include "scene/animated_transform.h"
#include "trace/body.h"

#include <memory>
#include <vector>

namespace slant {

/// Where a body is over the shutter: an instance's transform, times that of a body in its object.
class Placement {
public:
    explicit Placement(const MovingTransform& worldFromInstance, const MovingTransform& instanceFromBody = {})
        : outer_(worldFromInstance), inner_(instanceFromBody) {}
    bool moves() const { return outer_.moves() || inner_.moves(); }
    /// World from body.
    glm::dmat4 at(double time) const { return outer_.at(time) * inner_.at(time); }

private:
    AnimatedTransform outer_, inner_;
};

/// A placement at one time, and its inverse.
struct PlacedFrame {
    explicit PlacedFrame(const glm::dmat4& worldFromBody);
    SurfaceRay toBody(const SurfaceRay& ray) const {
        return {inverseLinear * (ray.origin - offset), inverseLinear * ray.direction};
    }
    /// From the body's space to the world.
    void toWorld(SurfaceHit& hit) const;

    glm::dmat3 linear, inverseLinear, normalMatrix;
    glm::dvec3 offset;
};

class Instance {
public:
    /// The body must be committed and live longer. Throws Error(badInput) for a singular placement.
    Instance(const Body& body, const Placement& placement);

    const Body& body() const { return *body_; }
    /// Null if it keeps still.
    const Placement* motion() const { return moving_ ? &moving_->placement : nullptr; }
    /// Calls visit(frame) with the frame at `time`, computing it only if it moves.
    template <typename Visit>
    void withFrame(float time, Visit&& visit) const {
        if (moving_)
            visit(PlacedFrame(moving_->placement.at(double(time))));
        else
            visit(still_);
    }
    /// For Embree; refers to this, and the number that it gets when it is attached is its instID.
    embree::GeometryPointer makeGeometry(RTCDevice device) const;
    /// World boxes at equally many times of the shutter; where the body is between them lies between them.
    const std::vector<Box>& stepBounds() const { return moving_->stepBounds; }

private:
    struct Moving {
        Placement placement;
        std::vector<Box> stepBounds;
    };
    embree::GeometryPointer makeMoving(RTCDevice device) const;

    const Body* body_;
    PlacedFrame still_; ///< at time 0
    std::unique_ptr<Moving> moving_;
};

} // namespace slant
