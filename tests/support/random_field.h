// What random cases do to light fields: fields of layers, other sample counts, rubbish.
#pragma once
#include "support/draw.h"
#include "support/shaded.h"

#include <limits>

namespace slant::test {

/// Layers that stand still or move, of few or many samples, with the parts of their radiance or without.
inline LightField randomLayers(Draw& draw) {
    const int x = draw.below(40) - 20, y = draw.below(40) - 20;
    const Rect frame{x, y, x + 1 + draw.below(90), y + 1 + draw.below(60)};
    const int overscan = draw.below(20), spp = 1 + draw.below(16);
    const std::uint32_t seed = draw.random.bits();
    LightField field;
    if (draw.chance(0.3f)) {
        const synthetic::MovingView view{
            .pinhole = draw.chance(0.2f), .open = draw(0, 0.4f), .close = draw(0.5f, 1)};
        field = synthetic::sampleMoving(draw.chance(0.5f) ? synthetic::movingDiscs()
                                                          : synthetic::overtakingDiscs(),
                                        frame, overscan, spp, seed, view);
    } else {
        std::vector<synthetic::Layer> layers = synthetic::discsOverChecks();
        const float blur = std::exp(draw(-4, 3));
        for (synthetic::Layer& layer : layers) layer.slope *= blur;
        if (draw.chance(0.2f)) layers.pop_back(); // the background
        field = synthetic::sample(layers, frame, overscan, spp, seed);
    }
    if (draw.chance(0.5f))
        lightUp(field, {.reflection = draw.chance(0.5f) ? 0.3f : 0,
                        .seed = seed,
                        .shadow = draw.chance(0.5f) ? draw(0.1f, 0.9f) : 0});
    return field;
}

/// Leaves out, keeps or doubles each sample by chance.
inline void thinOut(LightField& field, Draw& draw) {
    const float kept = draw(0.1f, 1), doubled = draw.chance(0.5f) ? draw(0, 0.5f) : 0;
    std::vector<std::size_t> taken;
    std::vector<std::uint32_t> counts;
    for (std::size_t pixel = 0; pixel < field.bounds.area(); ++pixel) {
        const std::size_t before = taken.size();
        for (std::size_t i = field.firstSample(pixel); i < field.firstSample(pixel + 1); ++i)
            if (draw.chance(kept)) taken.insert(taken.end(), draw.chance(doubled) ? 2 : 1, i);
        counts.push_back(std::uint32_t(taken.size() - before));
    }
    const auto take = [&](auto& values) {
        if (values.empty()) return;
        auto all = std::move(values);
        values.clear();
        for (const std::size_t i : taken) values.push_back(all[i]);
    };
    take(field.samples);
    for (const auto plane : kValuePlanes) take(field.*plane);
    setSampleCounts(field, counts);
}

/// Numbers that no renderer should write, here and there.
inline void spoil(LightField& field, Draw& draw) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNumbers[] = {std::numeric_limits<float>::quiet_NaN(),
                                  kInfinity,
                                  -kInfinity,
                                  0,
                                  -0.f,
                                  -1,
                                  1e-40f,
                                  1e-30f,
                                  1e6f,
                                  -3e8f,
                                  1e30f,
                                  3e38f,
                                  0.5f,
                                  1};
    const auto number = [&] { return kNumbers[draw.below(int(std::size(kNumbers)))]; };
    constexpr float LightFieldSample::*kMembers[] = {
        &LightFieldSample::x, &LightFieldSample::y, &LightFieldSample::u,     &LightFieldSample::v,
        &LightFieldSample::t, &LightFieldSample::w, &LightFieldSample::slope, &LightFieldSample::alpha};
    const float share = std::exp(draw(-7, -1));
    for (std::size_t i = 0; i < field.samples.size(); ++i) {
        if (draw.chance(share)) field.samples[i].*kMembers[draw.below(int(std::size(kMembers)))] = number();
        for (const auto plane : kValuePlanes)
            if (!(field.*plane).empty() && draw.chance(share)) (field.*plane)[i][draw.below(3)] = number();
    }
}

} // namespace slant::test
