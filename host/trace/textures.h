// Texture graphs of a scene, ready to be evaluated at a point of a surface.
//
// pbrt-v4's conventions: images are looked up at (s, 1 - t); a checkerboard shows its first texture where
// floor(s) + floor(t) is even; mappings other than uv work on the world position. Rays have no footprint
// here, so there is no filtering beyond that between texels.
#pragma once
#include "scene/scene.h"

#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace slant {

struct TexturePoint {
    glm::vec3 position{0}; ///< world space
    glm::vec2 uv{0};
    glm::vec3 normal{0, 0, 1}; ///< world space, unit
};

/// The meaning of a texture's value; pbrt treats image texels accordingly.
enum class TextureUse {
    albedo,    ///< colour in [0, 1]: texels are clamped to it
    unbounded, ///< colour >= 0
    number     ///< a number: the mean of a colour image's channels
};

/// Keeps pointers into the scene, which must live longer. Evaluation is const and free of allocation.
class Textures {
public:
    /// Throws Error(badInput) where a texture refers to a child or image that does not exist.
    explicit Textures(const Scene& scene);

    glm::vec3 evaluate(int texture, const TexturePoint& point, TextureUse use) const;
    bool contains(int texture) const { return texture >= 0 && texture < int(nodes_.size()); }
    /// True if the value is the same everywhere.
    bool isConstant(int texture) const { return nodes_[std::size_t(texture)].constant; }

private:
    struct Node {
        TextureKind kind;
        TextureMapping mapping;
        WrapMode wrap;
        TexelFilter filter;
        bool invert, constant;
        float scale;
        glm::vec3 value;
        std::array<int, 4> child;
        glm::vec2 uvScale, uvDelta;
        glm::vec4 planarS, planarT; ///< s = dot((x, y, z, 1), planarS); rows of the transform if not planar
        glm::vec4 row3;
        const Image* image;
        int octaves;
        float roughness, variation;
        glm::vec3 direction;
    };
    glm::vec3 evaluateRare(const Node& node, const TexturePoint& point, TextureUse use) const;
    glm::vec3 mixed(const Node& node, float amount, const TexturePoint& point, TextureUse use) const;
    static glm::vec3 place(const Node& node, const TexturePoint& point);
    static glm::vec2 map(const Node& node, const TexturePoint& point);
    static glm::vec3 texel(const Node& node, int x, int y);
    static glm::vec3 lookup(const Node& node, glm::vec2 st);
    static glm::vec3 evaluateImage(const Node& node, glm::vec2 st, TextureUse use);

    std::vector<Node> nodes_;
};

} // namespace slant
