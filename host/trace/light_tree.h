// A binary tree over emitters that picks one for a receiver with a chance that follows what it could
// contribute, in time logarithmic in their number (after Conty Estevez and Kulla 2018, "Importance Sampling
// of Many Lights with Adaptive Tree Splitting", without the splitting; importance as in pbrt-v4, Physically
// Based Rendering, 4th edition, section 12.6.3).
//
// Every emitter that can contribute has a chance above zero.
#pragma once
#include "trace/emitter.h"

#include <vector>

namespace slant {

/// What is known about an emitter, or a group of them, when choosing.
struct LightBounds {
    glm::vec3 low{0}, high{0}; ///< box of positions
    glm::vec3 axis{0, 0, 1};   ///< emitting normals lie within an angle around it
    float cosineSpread = 1;    ///< cosine of that angle; -1 = all directions
    bool twoSided = false;
    float intensity = 0; ///< radiance times area, or a point light's intensity

    static LightBounds join(const LightBounds& a, const LightBounds& b);
};

class LightTree {
public:
    /// `bounds[i]` belongs to emitter i.
    explicit LightTree(const std::vector<LightBounds>& bounds);
    LightTree() = default;

    bool empty() const { return nodes_.empty(); }
    /// Upper estimate of the irradiance at the receiver from all emitters; 0 only if none can contribute.
    float importance(const Receiver& receiver) const {
        return nodes_.empty() ? 0 : importance(nodes_[0], receiver);
    }
    /// Index of an emitter and the chance it had; u in [0, 1) is replaced by a fresh number. -1 if none can
    /// contribute.
    int sample(const Receiver& receiver, float& u, float& chance) const;
    /// The chance that sample() returns `emitter`.
    float chance(const Receiver& receiver, int emitter) const;

private:
    struct Node {
        glm::vec3 centre;
        float radius;
        glm::vec3 axis;
        float cosineSpread, sineSpread;
        float intensity;
        bool twoSided;
        int emitter = -1; ///< leaf
        int second = 0;   ///< inner node: children are the next node and this one
        int parent = -1;
    };
    static float importance(const Node& node, const Receiver& receiver);
    int build(const std::vector<LightBounds>& bounds, int* first, int* last, int parent);

    std::vector<Node> nodes_;
    std::vector<int> leafOf_;
};

} // namespace slant
