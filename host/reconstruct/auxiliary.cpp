#include "reconstruct/auxiliary.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slant {
namespace {

bool hit(const LightFieldSample& s) {
    return !std::isinf(s.w);
}

/// From a mean that has no sign.
float signedMean(float mean, float) {
    return 2 * mean - 1;
}

float unchanged(float mean, float) {
    return mean;
}

const std::array<AuxiliarySet, 4> kSets = {{
    {{"A"},
     [](const LightFieldSample& s, const AuxiliarySample&) { return glm::vec3(hit(s) ? 1 : 0); },
     unchanged},
    {{"Z"},
     [](const LightFieldSample& s, const AuxiliarySample&) { return glm::vec3(hit(s) ? s.w : 0); },
     [](float mean, float coverage) { return coverage > 0 ? mean / coverage : 0; }},
    {{"albedo.R", "albedo.G", "albedo.B"},
     [](const LightFieldSample&, const AuxiliarySample& auxiliary) { return auxiliary.albedo; },
     unchanged},
    {{"N.X", "N.Y", "N.Z"},
     [](const LightFieldSample&, const AuxiliarySample& auxiliary) {
         const glm::vec3& n = auxiliary.normal;
         return std::isfinite(n.x + n.y + n.z) ? 0.5f * n + 0.5f : glm::vec3(0.5f);
     },
     signedMean},
}};

} // namespace

std::span<const AuxiliarySet> auxiliarySets(bool withAlbedoAndNormals) {
    return {kSets.data(), withAlbedoAndNormals ? kSets.size() : 2};
}

void takeValues(LightField& field, const AuxiliarySet& set) {
    parallelFor(0, field.samples.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            LightFieldSample& s = field.samples[i];
            const glm::vec3 values =
                set.valuesOf(s, field.auxiliary.empty() ? AuxiliarySample{} : field.auxiliary[i]);
            const auto valid = [](float value) { return std::isfinite(value) && value > 0 ? value : 0.f; };
            s.r = valid(values.x), s.g = valid(values.y), s.b = valid(values.z);
        }
    });
}

std::vector<glm::vec3> radiancesOf(const LightField& field) {
    std::vector<glm::vec3> radiances;
    radiances.reserve(field.samples.size());
    for (const LightFieldSample& s : field.samples) radiances.emplace_back(s.r, s.g, s.b);
    return radiances;
}

void putRadiances(LightField& field, std::span<const glm::vec3> radiances) {
    for (std::size_t i = 0; i < radiances.size(); ++i) {
        LightFieldSample& s = field.samples[i];
        s.r = radiances[i].x, s.g = radiances[i].y, s.b = radiances[i].z;
    }
}

void addChannels(Image& image, const AuxiliarySet& set, const Image& means) {
    std::vector<std::string> channels = image.channels;
    channels.insert(channels.end(), set.channels.begin(), set.channels.end());
    Image wider(image.dataWindow, std::move(channels));
    wider.displayWindow = image.displayWindow;
    const auto before = std::size_t(image.channelCount()), after = std::size_t(wider.channelCount());
    const int coverage = image.channel("A");
    for (std::size_t pixel = 0; pixel < image.dataWindow.area(); ++pixel) {
        const float* const old = image.pixels.data() + before * pixel;
        std::copy_n(old, before, wider.pixels.data() + after * pixel);
        for (std::size_t c = before; c < after; ++c)
            wider.pixels[after * pixel + c] =
                set.finish(means.pixels[3 * pixel + c - before], coverage < 0 ? 1 : old[coverage]);
    }
    image = std::move(wider);
}

} // namespace slant
