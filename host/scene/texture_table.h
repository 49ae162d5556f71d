// Named textures and the parameters that take either a value or a texture.
#pragma once
#include "scene/parameters.h"
#include "scene/scene.h"
#include "scene/spectra.h"

#include <map>
#include <optional>
#include <string>

namespace slant {

class SceneFiles;

/// Builds Scene::textures. A texture may be named before it is defined (pbrt makes all of them at the end),
/// so definitions are kept and built when first needed.
class TextureTable {
public:
    /// All must outlive this.
    TextureTable(Scene& scene, SceneFiles& files, Issues& issues)
        : scene_(scene), files_(files), issues_(issues) {}

    /// `isFloat`: else a spectrum texture; the two have names of their own. `textureFromWorld` is the inverse
    /// of the transform at the directive. Throws Error(badInput) if the name is taken, unless it `mayReplace`
    /// what has it, as in older files.
    void define(bool isFloat, const std::string& name, const std::string& kind, ParameterList parameters,
                const glm::dmat4& textureFromWorld, bool mayReplace);

    /// From here on textures of other names or types are looked for as pbrt-v3 does: floats may be the red of
    /// a spectrum texture, and defaults take the place of what is not there.
    void takeForOlder() { older_ = true; }

    /// Index of the texture that the parameter `name` means; -1 if it is not there and has no `fallback`.
    int floatTexture(ParameterList& parameters, std::string_view name, std::optional<float> fallback,
                     Range range = {});
    int spectrumTexture(ParameterList& parameters, std::string_view name, SpectrumUse use,
                        std::optional<glm::vec3> fallback);

    /// Index of a texture of one value.
    int constant(glm::vec3 value);
    /// Builds unused textures too, so that their errors are found.
    void buildAll();

private:
    struct Definition {
        bool isFloat;
        std::string kind;
        ParameterList parameters;
        glm::dmat4 textureFromWorld;
        int index = -1;
        bool inProgress = false;
    };
    using Key = std::pair<bool, std::string>; // float?, name

    std::optional<int> named(bool isFloat, const Parameter& parameter);
    int build(Definition& definition);
    Texture make(Definition& definition);
    void makePattern(Texture& texture, Definition& definition);
    void readMapping(Texture& texture, Definition& definition);
    void readSpace(Texture& texture, Definition& definition);
    void readImage(Texture& texture, Definition& definition);
    int child(Definition& definition, std::string_view name, float fallback);
    bool isColour(Definition& definition, std::string_view name) const;

    Scene& scene_;
    SceneFiles& files_;
    Issues& issues_;
    std::map<Key, Definition> definitions_;
    int depth_ = 0;
    bool older_ = false;
};

} // namespace slant
