// The camera of a scene, of whatever kind. Both kinds offer
//
//     CameraSample sample(glm::vec2 raster, glm::vec2 square, float time) const
//                                                a ray, its lens position and weight
//     SlopeModel slopeModel() const              of trajectories seen in the middle
//     AnimatedTransform worldFromCamera() const
//     glm::dmat4x3 pinholeFromCamera() const     what the middle of the lens sees, in homogeneous coordinates
#pragma once
#include "camera/compound_lens.h"
#include "camera/thin_lens.h"
#include "scene/transforms.h"

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
    bool moves() const {
        return visit([](const auto& camera) { return camera.worldFromCamera().moves(); });
    }
    /// (x w, y w, w) of a point of the world at a time of the shutter: seen from the middle of the lens at
    /// raster position (x, y) and depth w; lightfield.h has points move along lines in these coordinates.
    glm::dmat4x3 pinholeFromWorld(double time) const {
        return visit([&](const auto& camera) {
            return camera.pinholeFromCamera() * affineInverse(camera.worldFromCamera().at(time));
        });
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
