// What stands before WorldBegin: film, filter, camera, sampler, integrator.
#pragma once
#include "scene/parameters.h"
#include "scene/scene.h"

#include <map>
#include <string>

namespace slant {

class SceneFiles;

/// Keeps the directives (the last of each kind counts, as in pbrt) until all are known, since the camera's
/// defaults depend on the film's size and the film's exposure on the camera's shutter.
class OptionBlock {
public:
    /// `issues` must outlive this.
    explicit OptionBlock(Issues& issues) : issues_(issues) {}

    /// `directive` is Film, PixelFilter, Camera, Sampler or Integrator.
    void set(const std::string& directive, const std::string& kind, ParameterList parameters);
    /// `times` of the scene, at which the camera has the two transforms.
    void setCameraTransform(const MovingTransform& worldFromCamera, const std::array<double, 2>& times) {
        worldFromCamera_ = worldFromCamera;
        cameraTimes_ = times;
    }

    /// Fills the scene's part of it, with pbrt's defaults.
    void resolve(Scene& scene, const SceneFiles& files);

private:
    struct Entity {
        std::string kind;
        ParameterList parameters;
    };

    Entity& entity(const std::string& directive, const std::string& defaultKind);
    void resolveCamera(Scene& scene, Entity& camera, const SceneFiles& files);

    Issues& issues_;
    std::map<std::string, Entity> entities_;
    MovingTransform worldFromCamera_;
    std::array<double, 2> cameraTimes_{0, 1};
};

} // namespace slant
