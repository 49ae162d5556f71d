// Area lights: turns the shapes of a scene that emit into emitters, one or two per triangle, patch or
// quadric.
#pragma once
#include "scene/scene.h"
#include "trace/moving_emitter.h"

#include <vector>

namespace slant {

/// Where the pieces of one shape with an area light lie among the emitters.
struct EmittingShape {
    int first;
    const Image* image; ///< of the radiance over its u and v, times that of its pieces; null: none
    bool patches; ///< two pieces per primitive: the halves beside p10-p01 of a flat patch, or the patch twice
};

struct EmittingShapes {
    std::vector<Emitter> emitters;
    std::vector<EmitterQuadric> quadrics;
    std::vector<EmitterMotion> motions;
    std::vector<EmittingShape> shapes; ///< one for each of Scene::shapes with an area light, in their order
};

/// Radiance follows pbrt-v4: `power`, in watts, is what each triangle, patch or quadric of the shape emits.
/// Those without area are not `sampled`. If a shape moves, its emitters are as at time 0, and power is by the
/// area then.
EmittingShapes makeEmitters(const Scene& scene);

} // namespace slant
