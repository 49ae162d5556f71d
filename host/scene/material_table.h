// Materials, named and not.
#pragma once
#include "scene/parameters.h"
#include "scene/scene.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace slant {

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
    void build(Scene& scene, TextureTable& textures);

private:
    struct Entry {
        std::string name;
        Position where; // first use or definition
        std::string kind;
        std::optional<ParameterList> parameters;
    };

    int indexOf(const std::string& name, const Position& where);
    Material built(Entry& entry, TextureTable& textures) const;

    Issues& issues_;
    std::vector<Entry> entries_;
    std::map<std::string, int> named_;
};

} // namespace slant
