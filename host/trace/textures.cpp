#include "trace/textures.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

int childCount(TextureKind kind) {
    switch (kind) {
    case TextureKind::constant:
    case TextureKind::imagemap:
        return 0;
    case TextureKind::scale:
    case TextureKind::checkerboard:
        return 2;
    case TextureKind::mix:
        return 3;
    }
    return 0;
}

/// The row of an affine map that takes a world point to its coordinate along `axis` in texture space.
glm::vec4 planarRow(const Texture& texture, glm::vec3 axis, float delta) {
    glm::dvec4 row = glm::transpose(texture.textureFromWorld) * glm::dvec4(axis, 0.0);
    row.w += double(delta);
    return glm::vec4(row);
}

/// Keeps a coordinate where conversion to int is safe; NaN becomes -1.
float bounded(float s) {
    return s >= -1 ? std::min(s, 2.f) : -1.f;
}

} // namespace

Textures::Textures(const Scene& scene) {
    nodes_.reserve(scene.textures.size());
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        const Texture& t = scene.textures[i];
        const FileLocation file{scene.path, 0, 0};
        Node node{t.kind,
                  t.mapping,
                  t.wrap,
                  t.filter,
                  t.invert,
                  t.kind == TextureKind::constant,
                  t.scale,
                  t.value,
                  {t.child[0], t.child[1], t.child[2]},
                  t.uvScale,
                  t.uvDelta,
                  planarRow(t, t.planarV1, t.uvDelta.x),
                  planarRow(t, t.planarV2, t.uvDelta.y),
                  nullptr};
        int children = childCount(t.kind);
        bool constantChildren = children > 0;
        for (int c = 0; c < children; ++c) {
            if (t.child[c] < 0 || t.child[c] >= int(i))
                throw badInput(file, "texture {} refers to texture {}, which is not defined before it", i,
                               t.child[c]);
            constantChildren = constantChildren && isConstant(t.child[c]);
        }
        node.constant = node.constant || (constantChildren && t.kind != TextureKind::checkerboard);
        if (t.kind == TextureKind::imagemap) {
            if (t.imageIndex < 0 || t.imageIndex >= int(scene.images.size()))
                throw badInput(file, "texture {} refers to image {}, which does not exist", i, t.imageIndex);
            node.image = &scene.images[std::size_t(t.imageIndex)];
            if (node.image->width() < 1 || node.image->height() < 1 ||
                (node.image->channelCount() != 1 && node.image->channelCount() != 3))
                throw badInput(file, "the image of texture {} is empty or does not have 1 or 3 channels", i);
        }
        nodes_.push_back(node);
    }
}

glm::vec3 Textures::evaluate(int texture, const TexturePoint& point, TextureUse use) const {
    const Node& node = nodes_[std::size_t(texture)];
    switch (node.kind) {
    case TextureKind::constant:
        return node.value;
    case TextureKind::scale: {
        float factor = evaluate(node.child[1], point, TextureUse::number).x;
        return factor == 0 ? glm::vec3(0) : factor * evaluate(node.child[0], point, use);
    }
    case TextureKind::mix: {
        float amount = evaluate(node.child[2], point, TextureUse::number).x;
        if (amount == 0) return evaluate(node.child[0], point, use);
        if (amount == 1) return evaluate(node.child[1], point, use);
        return (1 - amount) * evaluate(node.child[0], point, use) +
               amount * evaluate(node.child[1], point, use);
    }
    case TextureKind::checkerboard: {
        glm::vec2 cell = glm::floor(map(node, point));
        float halfSum = 0.5f * (cell.x + cell.y);
        return evaluate(node.child[halfSum == std::floor(halfSum) ? 0 : 1], point, use);
    }
    case TextureKind::imagemap:
        return evaluateImage(node, map(node, point), use);
    }
    return glm::vec3(0);
}

glm::vec2 Textures::map(const Node& node, const TexturePoint& point) {
    if (node.mapping == TextureMapping::uv) return node.uvScale * point.uv + node.uvDelta;
    glm::vec4 p(point.position, 1);
    return {glm::dot(p, node.planarS), glm::dot(p, node.planarT)};
}

glm::vec3 Textures::evaluateImage(const Node& node, glm::vec2 st, TextureUse use) {
    glm::vec3 value = node.scale * lookup(node, {st.x, 1 - st.y});
    if (use == TextureUse::number) {
        float mean = (value.x + value.y + value.z) / 3;
        return glm::vec3(node.invert ? std::max(0.f, 1 - mean) : mean);
    }
    value = glm::max(node.invert ? 1.f - value : value, 0.f);
    return use == TextureUse::albedo ? glm::min(value, 1.f) : value;
}

glm::vec3 Textures::lookup(const Node& node, glm::vec2 st) {
    for (int axis = 0; axis < 2; ++axis) {
        if (node.wrap == WrapMode::repeat) st[axis] -= std::floor(st[axis]);
        st[axis] = bounded(st[axis]);
    }
    glm::vec2 p = st * glm::vec2(node.image->width(), node.image->height());
    if (node.filter == TexelFilter::point) return texel(node, int(std::floor(p.x)), int(std::floor(p.y)));
    p -= 0.5f;
    glm::vec2 corner = glm::floor(p), f = p - corner;
    int x = int(corner.x), y = int(corner.y);
    return (1 - f.y) * ((1 - f.x) * texel(node, x, y) + f.x * texel(node, x + 1, y)) +
           f.y * ((1 - f.x) * texel(node, x, y + 1) + f.x * texel(node, x + 1, y + 1));
}

glm::vec3 Textures::texel(const Node& node, int x, int y) {
    int width = node.image->width(), height = node.image->height();
    if (x < 0 || x >= width || y < 0 || y >= height) {
        switch (node.wrap) {
        case WrapMode::black:
            return glm::vec3(0);
        case WrapMode::repeat:
            x = ((x % width) + width) % width;
            y = ((y % height) + height) % height;
            break;
        case WrapMode::octahedralSphere: // a neighbour beyond an edge lies mirrored along that edge
            if (x < 0 || x >= width) {
                x = x < 0 ? -x : 2 * width - 1 - x;
                y = height - 1 - y;
            }
            if (y < 0 || y >= height) {
                x = width - 1 - x;
                y = y < 0 ? -y : 2 * height - 1 - y;
            }
            [[fallthrough]];
        case WrapMode::clamp:
            x = std::clamp(x, 0, width - 1);
            y = std::clamp(y, 0, height - 1);
            break;
        }
    }
    const Image& image = *node.image;
    if (image.channelCount() == 1) return glm::vec3(image.at(x, y, 0));
    return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

} // namespace slant
