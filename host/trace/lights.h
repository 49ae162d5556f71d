// All lights of a scene: what they emit, and how a receiver samples them. Units are pbrt-v4's: with rgb
// colours and the default sensor, L times scale is the radiance that arrives in the image; "power" and
// "illuminance" replace the brightness but keep the colour (pbrt-v4, lights.cpp).
//
// A light is chosen in proportion to an estimate of the irradiance it could cause at the receiver: among
// distant and infinite lights and a LightTree over all emitters that have a place: wherever they are over the
// shutter, as the tree is the same at all times. Then they are sampled where they are at the receiver's time.
#pragma once
#include "trace/emitting_shapes.h"
#include "trace/environment.h"
#include "trace/interaction.h"
#include "trace/light_tree.h"
#include "trace/portal.h"

#include <deque>
#include <optional>

namespace slant {

/// Keeps pointers into the scene, which must live longer. Const calls may come from any thread.
class Lights {
public:
    /// Throws Error(badInput) for a light whose image or transform cannot be used.
    explicit Lights(const Scene& scene);

    /// Radiance that leaves the hit along wo (unit).
    glm::vec3 emitted(const SurfaceHit& hit, glm::vec3 wo) const;
    /// Every sampled light gives bounded estimates, and every emitter is sampled: diffuse surfaces need no
    /// other strategy.
    bool complete() const { return complete_; }
    /// That, for the emitter of a hit.
    bool complete(const SurfaceHit& hit) const;
    /// There is something for sample() to return.
    bool canSample() const { return optionCount() > 0; }
    /// sample() uses its `choice`.
    bool needsChoice() const { return needsChoice_; }
    /// Rays may meet light: there are area or infinite lights.
    bool canBeSeen() const { return !shapes_.empty() || !infinite_.empty(); }
    /// False if no light comes from the sample. `choice` and u uniform in [0, 1).
    bool sample(const Receiver& receiver, float choice, glm::vec2 u, LightSample& sample) const;
    /// Density with which sample() returns `direction`, along which `hit` with an emitter lies.
    float pdf(const Receiver& receiver, const SurfaceHit& hit, glm::vec3 direction) const;

    std::size_t infiniteCount() const { return infinite_.size(); }
    const Environment& infinite(std::size_t i) const { return infinite_[i]; }
    /// Radiance of infinite light i that arrives at `position` along `direction` (unit, towards the light).
    glm::vec3 infiniteRadiance(std::size_t i, glm::vec3 position, glm::vec3 direction) const {
        if (portals_[i] && !portals_[i]->shows(position, direction)) return glm::vec3(0);
        return infinite_[i].radiance(direction);
    }
    /// Whether estimates of infinite light i are bounded.
    bool infiniteBounded(std::size_t i) const { return !portals_[i]; }
    /// Density with which sample() returns `direction` as one of infinite light i.
    float infinitePdf(const Receiver& receiver, std::size_t i, glm::vec3 direction) const;

private:
    struct Distant {
        glm::vec3 direction; ///< unit, towards the light
        glm::vec3 radiance;  ///< irradiance on a surface that faces it
    };
    /// What the tree chooses: an emitter, or the two halves of a flat quadrilateral.
    struct Leaf {
        int first, second; ///< second -1: none
        float firstChance;
    };
    void addLight(const Scene& scene, const Light& light);
    void addPointLight(const Scene& scene, const Light& light);
    void addInfiniteLight(const Scene& scene, const Light& light);
    void addTree();
    /// Calls use(emitter, quadrics) with an emitter as it is at a time.
    template <typename Use>
    auto withEmitter(int piece, float time, Use&& use) const;
    /// Where it may be over the shutter.
    LightBounds boundsOf(const Emitter& emitter) const;
    /// Index of the emitter that was hit.
    int pieceOf(const SurfaceHit& hit) const;
    /// Options are the infinite lights, the distant ones and the tree, in this order.
    float importance(std::size_t option, const Receiver& receiver) const;
    /// An option, its chance, and a fresh number in place of `choice`; -1 if none can contribute.
    int chooseOption(const Receiver& receiver, float& choice, float& chance) const;
    float optionChance(std::size_t option, const Receiver& receiver) const;
    std::size_t optionCount() const { return infinite_.size() + distant_.size() + (tree_.empty() ? 0 : 1); }

    std::vector<Emitter> emitters_;
    std::vector<EmitterQuadric> quadrics_;
    std::vector<EmitterMotion> motions_;
    std::vector<EmittingShape> shapes_;
    std::vector<Environment> infinite_;
    std::vector<std::optional<Portal>> portals_; ///< of infinite lights
    std::vector<Distant> distant_;
    std::deque<PointProfile> profiles_; ///< of points
    LightTree tree_;
    std::vector<Leaf> leaves_; ///< as the tree numbers them
    std::vector<int> leafOf_;  ///< for each emitter; -1 = not sampled
    bool complete_ = true, needsChoice_ = false;
};

} // namespace slant
