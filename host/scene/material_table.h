// Materials, named and not.
#pragma once
#include "scene/parameters.h"
#include "scene/scene.h"

#include <deque>
#include <map>
#include <optional>
#include <string>

namespace slant {

class SceneFiles;
class TextureTable;

/// Hands out the indices of Scene::materials at once and builds them at the end, since pbrt lets a material
/// be named before it is made. Index 0 is pbrt's default, diffuse.
class MaterialTable {
public:
    /// `issues` must outlive this.
    explicit MaterialTable(Issues& issues);

    /// Material: index of a new material.
    int add(const std::string& kind, ParameterList parameters);
    /// MakeNamedMaterial. Throws Error(badInput) if the name is taken, unless it `mayReplace` what has it
    /// from here on, as in older files.
    void define(const std::string& name, const std::string& kind, ParameterList parameters, bool mayReplace);
    /// NamedMaterial: index of the material of that name.
    int use(const std::string& name, const Position& where);

    /// Fills `scene.materials`; names that were used but never made are issues. Grey stands in.
    void build(Scene& scene, TextureTable& textures, SceneFiles& files);

private:
    struct Entry {
        std::string name;
        Position where; // first use or definition
        std::string kind;
        std::optional<ParameterList> parameters;
    };

    int indexOf(const std::string& name, const Position& where);
    Material read(Entry& entry, TextureTable& textures, SceneFiles& files);
    void readMix(Material& material, ParameterList& parameters, TextureTable& textures);
    Material built(Entry& entry, TextureTable& textures, SceneFiles& files);
    void checkMixes(const Scene& scene) const;

    Issues& issues_;
    std::deque<Entry> entries_;
    std::map<std::string, int> named_;
};

/// Takes out the shapes that are "interface": light passes them, and without media they do nothing.
void dropInterfaces(Scene& scene);

} // namespace slant
