#include "render/auxiliary.h"

namespace slant {
namespace {

glm::vec3 unchanged(glm::vec3 mean, float) {
    return mean;
}

glm::vec3 depthOfHits(glm::vec3 mean, float coverage) {
    return coverage > 0 ? mean / coverage : glm::vec3(0);
}

glm::vec3 signedNormal(glm::vec3 mean, float) {
    return {fromNormalValue(mean.x), fromNormalValue(mean.y), fromNormalValue(mean.z)};
}

glm::vec3 signedMotion(glm::vec3 mean, float) {
    return {fromForwardValue(mean), 0};
}

} // namespace

std::vector<AuxiliarySet> auxiliarySets(bool withGuides, bool withMotion) {
    std::vector<AuxiliarySet> sets = {{ValuePlane::coverage, {"A"}, unchanged},
                                      {ValuePlane::depth, {"Z"}, depthOfHits}};
    if (withGuides) {
        sets.push_back({ValuePlane::albedo, {"albedo.R", "albedo.G", "albedo.B"}, unchanged});
        sets.push_back({ValuePlane::normal, {"N.X", "N.Y", "N.Z"}, signedNormal});
    }
    if (withMotion) sets.push_back({ValuePlane::forward, {"forward.u", "forward.v"}, signedMotion});
    return sets;
}

void addChannels(Image& image, const AuxiliarySet& set, const Image& means) {
    Image wider = image.withMoreChannels(set.channels);
    const auto before = std::size_t(image.channelCount()), after = std::size_t(wider.channelCount());
    const int coverage = image.channel("A");
    for (std::size_t pixel = 0; pixel < image.dataWindow.area(); ++pixel) {
        const float* const old = image.pixels.data() + before * pixel;
        const float* const mean = means.pixels.data() + 3 * pixel;
        const glm::vec3 values = set.finish({mean[0], mean[1], mean[2]}, coverage < 0 ? 1 : old[coverage]);
        for (std::size_t c = before; c < after; ++c)
            wider.pixels[after * pixel + c] = values[int(c - before)];
    }
    image = std::move(wider);
}

} // namespace slant
