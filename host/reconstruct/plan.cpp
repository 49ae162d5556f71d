#include "reconstruct/plan.h"

#include "base/error.h"

#include <algorithm>

namespace slant {

std::vector<Band> planBands(const Rect& frame, const FilterTable& filter, int planes,
                            std::uint64_t maxSamples, int maxRows) {
    const int reach = filter.reach.y;
    const std::uint64_t rowSamples = std::uint64_t(frame.width() + 2 * filter.reach.x) * planes;
    const std::uint64_t rowsThatFit = maxSamples / std::max<std::uint64_t>(rowSamples, 1);
    const int rows =
        int(std::min<std::uint64_t>(rowsThatFit, std::uint64_t(frame.height() + kTileSize + 2 * reach)));
    const int bandRows = std::min(rows - 2 * reach, maxRows) / kTileSize * kTileSize;
    if (bandRows < kTileSize)
        throw Error(
            ErrorCode::resources,
            fmt::format("the memory budget is too small for a picture {} pixels wide: it needs {} MiB for "
                        "dense samples",
                        frame.width(), (rowSamples * (kTileSize + 2 * reach) * sizeof(vec4) >> 20) + 1));
    const Rect whole = outputRegion(frame, filter);
    std::vector<Band> bands;
    for (int y = frame.y0; y < frame.y1; y += bandRows) {
        const int end = std::min(y + bandRows, frame.y1);
        bands.push_back({y, end, {whole.x0, y - reach, whole.x1, end + reach}});
    }
    return bands;
}

Rect outputRegion(const Rect& frame, const FilterTable& filter) {
    return {frame.x0 - filter.reach.x, frame.y0 - filter.reach.y, frame.x1 + filter.reach.x,
            frame.y1 + filter.reach.y};
}

void checkBudget(const Rect& frame, int mostSamplesPerPixel, const ReconstructOptions& options) {
    const int planes = traitsOf(options.method).makesOutputs() ? std::min(kFilmBlock, options.outputsPerPixel)
                                                               : mostSamplesPerPixel;
    planBands(frame, makeFilterTable(options.filter), planes, maxDenseSamples(options));
}

namespace {

OutputLayout layoutOf(const Band& band, const OutputPattern& pattern, std::uint64_t seed) {
    OutputLayout layout;
    layout.regionOrigin = ivec2(band.region.x0, band.region.y0);
    layout.regionSize = ivec2(band.region.width(), band.region.height());
    layout.tileCount = (layout.regionSize + kTileSize - 1) / kTileSize;
    layout.outputsPerPixel = pattern.outputsPerPixel();
    layout.seed = uint(seed ^ seed >> 32);
    return layout;
}

} // namespace

Plan planOutputs(const Rect& frame, const FilterTable& filter, const OutputPattern& pattern,
                 std::uint64_t maxSamples, int maxRows) {
    const int block = std::min(kFilmBlock, pattern.outputsPerPixel());
    Plan plan;
    plan.bands = planBands(frame, filter, block, maxSamples, maxRows);
    for (const Band& band : plan.bands)
        plan.outputs += band.region.area() * std::uint64_t(pattern.outputsPerPixel());
    const std::uint64_t blocksThatFit = maxSamples / (plan.bands.front().region.area() * block);
    const auto blocks =
        std::clamp<std::uint64_t>(blocksThatFit, 1, std::uint64_t(pattern.outputsPerPixel() / block));
    plan.groupsPerChunk = int(blocks) * block / pattern.groupSize();
    return plan;
}

std::vector<Chunk> chunksOf(const Plan& plan, const Band& band, const OutputPattern& pattern,
                            std::uint64_t seed) {
    std::vector<Chunk> chunks;
    const int groups = int(pattern.groups.size());
    for (int group = 0; group < groups; group += plan.groupsPerChunk) {
        const int count = std::min(plan.groupsPerChunk, groups - group);
        chunks.push_back({band, layoutOf(band, pattern, seed), group, count, group << pattern.groupBits,
                          count << pattern.groupBits});
    }
    return chunks;
}

} // namespace slant
