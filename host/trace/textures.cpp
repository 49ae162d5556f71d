#include "trace/textures.h"

#include "base/error.h"
#include "trace/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slant {
namespace {

int childCount(TextureKind kind) {
    switch (kind) {
    case TextureKind::scale:
    case TextureKind::product:
    case TextureKind::directionMix:
    case TextureKind::checkerboard:
    case TextureKind::dots:
        return 2;
    case TextureKind::mix:
        return 3;
    case TextureKind::bilerp:
        return 4;
    default:
        return 0;
    }
}

/// The row of an affine map that takes a world point to its coordinate along `axis` in texture space.
glm::vec4 planarRow(const Texture& texture, glm::vec3 axis, float delta) {
    glm::dvec4 row = glm::transpose(texture.textureFromWorld) * glm::dvec4(axis, 0.0);
    row.w += double(delta);
    return glm::vec4(row);
}

/// Whether the value depends on nothing but the children.
bool isMixture(TextureKind kind) {
    return kind == TextureKind::scale || kind == TextureKind::product || kind == TextureKind::mix;
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
                  t.child,
                  t.uvScale,
                  t.uvDelta,
                  planarRow(t, t.planarV1, t.uvDelta.x),
                  planarRow(t, t.planarV2, t.uvDelta.y),
                  planarRow(t, {0, 0, 1}, 0),
                  nullptr,
                  t.octaves,
                  t.roughness,
                  t.variation,
                  t.direction};
        int children = childCount(t.kind);
        bool constantChildren = children > 0;
        for (std::size_t c = 0; c < std::size_t(children); ++c) {
            if (t.child[c] < 0 || t.child[c] >= int(i))
                throw badInput(file, "texture {} refers to texture {}, which is not defined before it", i,
                               t.child[c]);
            constantChildren = constantChildren && isConstant(t.child[c]);
        }
        node.constant = node.constant || (constantChildren && isMixture(t.kind));
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
    case TextureKind::mix:
        return mixed(node, evaluate(node.child[2], point, TextureUse::number).x, point, use);
    case TextureKind::checkerboard: {
        if (node.mapping == TextureMapping::space) return evaluateRare(node, point, use);
        glm::vec2 cell = glm::floor(map(node, point));
        float halfSum = 0.5f * (cell.x + cell.y);
        return evaluate(node.child[halfSum == std::floor(halfSum) ? 0 : 1], point, use);
    }
    case TextureKind::imagemap:
        return evaluateImage(node, map(node, point), use);
    default:
        return evaluateRare(node, point, use);
    }
}

glm::vec3 Textures::mixed(const Node& node, float amount, const TexturePoint& point, TextureUse use) const {
    if (amount == 0) return evaluate(node.child[0], point, use);
    if (amount == 1) return evaluate(node.child[1], point, use);
    return (1 - amount) * evaluate(node.child[0], point, use) + amount * evaluate(node.child[1], point, use);
}

/// The rest, out of the way of what most scenes need.
glm::vec3 Textures::evaluateRare(const Node& node, const TexturePoint& point, TextureUse use) const {
    const auto child = [&](std::size_t i) { return evaluate(node.child[i], point, use); };
    switch (node.kind) {
    case TextureKind::product:
        return child(0) * child(1);
    case TextureKind::directionMix:
        return mixed(node, 1 - std::min(std::abs(glm::dot(point.normal, node.direction)), 1.f), point, use);
    case TextureKind::bilerp: {
        const glm::vec2 st = map(node, point);
        return glm::mix(glm::mix(child(0), child(2), st.x), glm::mix(child(1), child(3), st.x), st.y);
    }
    case TextureKind::checkerboard: {
        const glm::vec3 cell = glm::floor(place(node, point));
        const float halfSum = 0.5f * (cell.x + cell.y + cell.z);
        return child(halfSum == std::floor(halfSum) ? 0 : 1);
    }
    case TextureKind::dots:
        return child(isInDot(map(node, point)) ? 0 : 1);
    case TextureKind::fbm:
        return glm::vec3(fractalNoise(place(node, point), node.roughness, node.octaves));
    case TextureKind::wrinkled:
        return glm::vec3(turbulence(place(node, point), node.roughness, node.octaves));
    case TextureKind::windy: {
        const glm::vec3 p = place(node, point);
        return glm::vec3(std::abs(fractalNoise(0.1f * p, 0.5f, 3)) * fractalNoise(p, 0.5f, 6));
    }
    case TextureKind::marble:
        return marble(node.scale * place(node, point), node.variation, node.roughness, node.octaves);
    default:
        return glm::vec3(0);
    }
}

/// In texture space.
glm::vec3 Textures::place(const Node& node, const TexturePoint& point) {
    const glm::vec4 p(point.position, 1);
    return {glm::dot(p, node.planarS), glm::dot(p, node.planarT), glm::dot(p, node.row3)};
}

glm::vec2 Textures::map(const Node& node, const TexturePoint& point) {
    if (node.mapping == TextureMapping::uv) return node.uvScale * point.uv + node.uvDelta;
    glm::vec4 p(point.position, 1);
    if (node.mapping == TextureMapping::planar) return {glm::dot(p, node.planarS), glm::dot(p, node.planarT)};
    const glm::vec3 q = place(node, point);
    const float turn = std::atan2(q.y, q.x) / (2 * std::numbers::pi_v<float>);
    if (node.mapping == TextureMapping::cylindrical) return {turn + 0.5f, q.z};
    const float length = glm::length(q);
    const float polar = length > 0 ? std::acos(std::clamp(q.z / length, -1.f, 1.f)) : 0.f;
    return {polar / std::numbers::pi_v<float>, turn < 0 ? turn + 1 : turn};
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
