// The camera of a scene, of whatever kind. All kinds offer
//
//     CameraSample sample(glm::vec2 raster, glm::vec2 square, float time) const
//                                                a ray, its lens position and weight
//     SlopeModel slopeModel() const              of trajectories seen in the middle
//     AnimatedTransform worldFromCamera() const
//     glm::dmat4x3 pinholeFromCamera() const     what the middle of the lens sees, in homogeneous coordinates
#pragma once
#include "camera/compound_lens.h"
#include "camera/parallel_view.h"
#include "camera/spherical_view.h"
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
    /// Whether depths don't matter for where points are seen.
    bool isParallel() const { return std::holds_alternative<ParallelView>(kind_); }
    /// Whether points that move straight are seen to do so.
    bool isProjective() const { return !std::holds_alternative<SphericalView>(kind_); }
    /// The lens, if the camera is of that kind.
    const CompoundLens* compoundLens() const { return std::get_if<CompoundLens>(&kind_); }

    /// Empty unless the lens is a compound lens.
    LensMap lensMap() const { return compoundLens() ? compoundLens()->lensMap() : LensMap(); }

private:
    using Kind = std::variant<ThinLens, CompoundLens, ParallelView, SphericalView>;
    static Kind make(const Scene& scene) {
        if (scene.realistic) return CompoundLens(*scene.realistic, scene.camera.worldFromCamera, scene.film);
        switch (scene.camera.projection) {
        case Projection::perspective:
            break;
        case Projection::parallel:
            if (scene.camera.lensRadius == 0) return ParallelView(scene.camera, scene.film);
            break;
        case Projection::equalArea:
        case Projection::equirectangular:
            return SphericalView(scene.camera, scene.film);
        }
        return ThinLens(scene.camera, scene.film);
    }

    Kind kind_;
};

} // namespace slant
