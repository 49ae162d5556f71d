// Light fields whose picture is known: layers of constant slope, front to back, each an inside test and a
// colour over pinhole position, sampled by a jittered pattern.
#pragma once
#include "lightfield/lightfield.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace slant::synthetic {

/// PCG hash of O'Neill's 32-bit generator family, as a stream.
class Random {
public:
    explicit Random(std::uint32_t seed) : state_(seed * 747796405u + 2891336453u) {}
    std::uint32_t bits() {
        state_ = state_ * 747796405u + 2891336453u;
        const std::uint32_t word = ((state_ >> ((state_ >> 28) + 4)) ^ state_) * 277803737u;
        return (word >> 22) ^ word;
    }
    float uniform() { return float(bits() >> 8) * 0x1p-24f; }

private:
    std::uint32_t state_;
};

struct Layer {
    float slope;
    std::function<bool(glm::vec2)> inside;
    std::function<glm::vec3(glm::vec2)> colour;
};

/// A plane that moves: all as it is in the middle of the shutter, the motion over the whole shutter relative
/// to its depth there (relativeMotion).
struct MovingLayer {
    Layer middle;
    glm::vec3 motion{0};
};
/// Through which their slopes tell their depth.
inline constexpr SlopeModel kMovingLens{-30, 15};

/// How moving layers are looked at.
struct MovingView {
    bool pinhole = false;      ///< through the lens's centre, and with slopes of 0
    float open = 0, close = 1; ///< when samples are taken
    bool stands = false;       ///< samples have no motion, as if nothing moved
};

struct MovingLayers {
    std::vector<MovingLayer> layers;
    MovingView view;
};

/// Adds the nearest layer (they are ordered front to back) that is hit, as a sample.
inline void look(LightField& field, const std::vector<Layer>& layers, glm::vec2 xy, glm::vec2 uv, float t) {
    LightFieldSample s{xy.x, xy.y, uv.x, uv.y, t, INFINITY, 0, 0};
    glm::vec3 radiance(0);
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const glm::vec2 p = xy - layers[i].slope * uv;
        if (!layers[i].inside(p)) continue;
        s.w = float(i + 1);
        s.slope = layers[i].slope;
        s.alpha = 1;
        radiance = layers[i].colour(p);
        break;
    }
    field.samples.push_back(s);
    field.radiance.push_back(radiance);
}

/// The same for layers that move, in any order: the nearest at its time counts.
inline void look(LightField& field, const MovingLayers& moving, glm::vec2 xy, glm::vec2 uv, float t) {
    const MovingView& view = moving.view;
    const SlopeModel lens = view.pinhole ? SlopeModel{0, 0} : kMovingLens;
    if (view.pinhole) uv = glm::vec2(0);
    t = view.open + t * (view.close - view.open);
    LightFieldSample s{xy.x, xy.y, uv.x, uv.y, t, INFINITY, lens.c2, 0};
    glm::vec3 radiance(0), motion(0);
    for (const MovingLayer& layer : moving.layers) {
        const float depth = 1 + (t - 0.5f) * layer.motion.z;
        const float w = kMovingLens.c1 / (layer.middle.slope - kMovingLens.c2);
        const glm::vec2 seen = xy - lens(w * depth) * uv;
        const glm::vec2 p = seen * depth - (t - 0.5f) * glm::vec2(layer.motion);
        if (!(w * depth < s.w) || !layer.middle.inside(p)) continue;
        s.w = w * depth;
        s.slope = lens(s.w);
        s.alpha = 1;
        motion = layer.motion * w;
        radiance = layer.middle.colour(p);
    }
    field.slopeModel = lens;
    field.samples.push_back(s);
    field.radiance.push_back(radiance);
    if (!view.stands) field.motion.push_back(motion);
}

/// Adds a pixel's samples: a sqrt(spp)-ish grid in the pixel, jittered, and a shuffled one on the lens.
template <typename Layers>
void addPixel(LightField& field, const Layers& layers, int x, int y, int spp, std::uint32_t seed,
              const Aperture& aperture) {
    const int columns = std::max(1, int(std::lround(std::sqrt(double(spp)))));
    const int rows = (spp + columns - 1) / columns;
    Random random(seed + std::uint32_t(y * 7919 + x * 104729));
    const std::uint32_t shift = random.bits();
    for (int i = 0; i < spp; ++i) {
        const auto stratum = [&](int k, int count) { return (float(k) + random.uniform()) / float(count); };
        const float fx = stratum(i % columns, columns), fy = stratum(i / columns, rows);
        const int j = int((std::uint32_t(i) + shift) % std::uint32_t(spp));
        const float r = std::sqrt(stratum(j, spp));
        const float phi = 6.2831853f * std::fmod(float(j) * 0.618034f + random.uniform() / float(spp), 1.f);
        const glm::vec2 lens = aperture.isDisc() ? r * glm::vec2(std::cos(phi), std::sin(phi))
                                                 : aperture.at({2 * r * r - 1, phi * (2 / 6.2831853f) - 1});
        look(field, layers, {float(x) + fx, float(y) + fy}, lens, random.uniform());
    }
}

/// countAt(x, y) samples in each pixel of the frame and its overscan.
template <typename Layers>
LightField sampleLayers(const Layers& layers, Rect frame, int overscan,
                        const std::function<int(int x, int y)>& countAt, std::uint32_t seed,
                        const Aperture& aperture) {
    LightField field;
    field.aperture = aperture;
    field.frame = frame;
    field.bounds = frame.expand(overscan);
    std::vector<std::uint32_t> counts;
    for (int y = field.bounds.y0; y < field.bounds.y1; ++y)
        for (int x = field.bounds.x0; x < field.bounds.x1; ++x) {
            counts.push_back(std::uint32_t(countAt(x, y)));
            addPixel(field, layers, x, y, int(counts.back()), seed, aperture);
        }
    setSampleCounts(field, counts);
    return field;
}

inline LightField sample(const std::vector<Layer>& layers, Rect frame, int overscan,
                         const std::function<int(int x, int y)>& countAt, std::uint32_t seed,
                         const Aperture& aperture = {}) {
    return sampleLayers(layers, frame, overscan, countAt, seed, aperture);
}

/// Equally many in every pixel.
inline LightField sample(const std::vector<Layer>& layers, Rect frame, int overscan, int spp,
                         std::uint32_t seed, const Aperture& aperture = {}) {
    return sampleLayers(
        layers, frame, overscan, [=](int, int) { return spp; }, seed, aperture);
}
inline LightField sampleMoving(const std::vector<MovingLayer>& layers, Rect frame, int overscan, int spp,
                               std::uint32_t seed, const MovingView& view = {}) {
    return sampleLayers(MovingLayers{layers, view}, frame, overscan, [=](int, int) { return spp; }, seed, {});
}

/// A number that is the same for a pixel in every run.
inline std::uint32_t pixelHash(int x, int y) {
    return Random(std::uint32_t(x * 7919 + y * 104729 + 77)).bits();
}

/// Sample counts like those of adaptive renderers, at their worst.
struct Counts {
    const char* name;
    std::function<int(int x, int y)> at;
};
inline std::vector<Counts> varyingCounts(Rect frame) {
    const int middle = (frame.x0 + frame.x1) / 2;
    return {{"2 beside 16", [=](int x, int) { return x < middle ? 2 : 16; }},
            {"checkerboard of 1 and 8", [](int x, int y) { return (x + y) & 1 ? 8 : 1; }},
            {"1 to 32 by chance", [](int x, int y) { return 1 + int(pixelHash(x, y) % 32); }},
            {"8, and one in four without", [](int x, int y) { return pixelHash(x, y) % 4 == 0 ? 0 : 8; }},
            {"1, and one in four without", [](int x, int y) { return pixelHash(x, y) % 4 == 0 ? 0 : 1; }}};
}

/// Discs in focus behind blurred discs, before a blurred checkerboard.
inline std::vector<Layer> discsOverChecks() {
    const auto disc = [](glm::vec2 p, float pitch, float radius) {
        const glm::vec2 q = p - pitch * glm::floor(p / pitch) - pitch / 2;
        return glm::dot(q, q) < radius * radius;
    };
    return {
        {-12, [=](glm::vec2 p) { return disc(p, 60, 13); },
         [](glm::vec2 p) { return glm::vec3(0.9f, 0.3f + 0.2f * std::sin(p.x * 0.5f), 0.1f); }},
        {0.3f, [=](glm::vec2 p) { return disc(p + 22.f, 37, 10); },
         [](glm::vec2 p) { return glm::vec3(0.2f, 0.5f, 0.5f + 0.4f * std::sin(p.x) * std::sin(p.y)); }},
        {9, [](glm::vec2) { return true; },
         [](glm::vec2 p) {
             const bool odd = (int(std::floor(p.x / 9)) + int(std::floor(p.y / 9))) & 1;
             return odd ? glm::vec3(0.8f) : glm::vec3(0.1f, 0.2f, 0.1f);
         }},
    };
}

/// The same, with all in motion: discs that cross each other, one kind towards the camera, and a background
/// that goes by.
inline std::vector<MovingLayer> movingDiscs() {
    const std::vector<Layer> layers = discsOverChecks();
    return {{layers[0], {14, 5, -0.3f}}, {layers[1], {-20, 12, 0}}, {layers[2], {6, 0, 0.1f}}};
}

/// Discs that come from behind others, through the plane in focus, and end in front of them; before a
/// background that keeps still.
inline std::vector<MovingLayer> overtakingDiscs() {
    const std::vector<Layer> layers = discsOverChecks();
    Layer coming = layers[1], going = layers[0];
    coming.slope = 1;
    going.slope = 0.4f;
    return {{coming, {-9, 4, -0.9f}}, {going, {11, 3, 0.2f}}, {layers[2], {}}};
}

} // namespace slant::synthetic
