#include "render/auxiliary.h"

#include <algorithm>
#include <array>

namespace slant {
namespace {

float unchanged(float mean, float) {
    return mean;
}

const std::array<AuxiliarySet, 4> kSets = {{
    {ValuePlane::coverage, {"A"}, unchanged},
    {ValuePlane::depth, {"Z"}, [](float mean, float coverage) { return coverage > 0 ? mean / coverage : 0; }},
    {ValuePlane::albedo, {"albedo.R", "albedo.G", "albedo.B"}, unchanged},
    {ValuePlane::normal, {"N.X", "N.Y", "N.Z"}, [](float mean, float) { return fromNormalValue(mean); }},
}};

} // namespace

std::span<const AuxiliarySet> auxiliarySets(bool withGuides) {
    return {kSets.data(), withGuides ? kSets.size() : 2};
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
