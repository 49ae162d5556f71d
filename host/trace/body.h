// Bodies: shapes that keep together, the unit that Embree searches. The world's own shapes that stand still
// are one, those of an object definition another; shapes in a row that move alike are a body each.
#pragma once
#include "scene/scene.h"
#include "trace/embree_objects.h"
#include "trace/surface.h"

#include <deque>
#include <memory>
#include <vector>

namespace slant {

/// A shape as Embree's geometry `geomID` of its body, and what hits on it carry.
struct Entry {
    std::unique_ptr<Surface> surface;
    int materialIndex;
    int emitter; ///< index among the emitters (EmitterId); -1: none
    int alpha;   ///< Shape::alpha
};

struct Body {
    std::vector<Entry> entries;
    embree::ScenePointer scene;

    explicit Body(RTCDevice device) : scene(embree::newScene(device)) {}
    void add(const Shape& shape, const std::vector<Mesh>& meshes, int emitter, RTCDevice device);
    /// In the body's own space, once its scene is committed.
    Box bounds() const;
};

/// A body that moves, in the space of its own shapes' vertices.
struct MovingBody {
    Body body;
    MovingTransform placement;
};

/// The shapes of the world or of an object definition.
struct BodyGroup {
    Body still;
    std::deque<MovingBody> moving;

    explicit BodyGroup(RTCDevice device) : still(device) {}
    void add(const Shape& shape, const std::vector<Mesh>& meshes, int emitter, RTCDevice device);
};

} // namespace slant
