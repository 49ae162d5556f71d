// The camera of a scene, of whatever kind. Both kinds offer
//
//     CameraSample sample(glm::vec2 raster, glm::vec2 square) const   a ray, its lens position and weight
//     SlopeModel slopeModel() const                                   of trajectories seen in the middle
#pragma once
#include "camera/compound_lens.h"
#include "camera/thin_lens.h"

#include <variant>

namespace slant {

class Camera {
public:
    /// Throws what the constructors of the kinds throw.
    explicit Camera(const Scene& scene) : kind_(make(scene)) {}

    /// Calls body(camera) with the concrete camera, so that a loop inside pays for the choice once.
    template <typename Body>
    decltype(auto) visit(Body&& body) const {
        return std::visit(body, kind_);
    }
    SlopeModel slopeModel() const {
        return visit([](const auto& camera) { return camera.slopeModel(); });
    }
    /// The opening over which lens positions are spread.
    Aperture aperture() const {
        return visit([](const auto& camera) { return camera.aperture(); });
    }
    /// The lens, if the camera is of that kind.
    const CompoundLens* compoundLens() const { return std::get_if<CompoundLens>(&kind_); }

    /// Empty unless the lens is a compound lens.
    LensMap lensMap() const { return compoundLens() ? compoundLens()->lensMap() : LensMap(); }

private:
    using Kind = std::variant<ThinLens, CompoundLens>;
    static Kind make(const Scene& scene) {
        if (scene.realistic) return CompoundLens(*scene.realistic, scene.camera.worldFromCamera, scene.film);
        return ThinLens(scene.camera, scene.film);
    }

    Kind kind_;
};

} // namespace slant
