#include "reconstruct/plan.h"

#include "base/error.h"

#include <algorithm>

namespace slant {

Plan planOutputs(const Rect& frame, const FilterTable& filter, const OutputPattern& pattern,
                 std::uint32_t seed, std::uint64_t memoryBytes, std::uint64_t maxDenseSamples) {
    const int groupSize = std::min(kOutputsPerGroup, pattern.outputsPerPixel());
    const std::uint64_t samples = std::min(memoryBytes / sizeof(vec4), maxDenseSamples);
    const std::uint64_t width = std::uint64_t(frame.width() + 2 * filter.reach.x);
    const std::uint64_t rowsThatFit = samples / (width * groupSize);
    const int reach = filter.reach.y;
    const int tileRows = (frame.height() + kTileSize - 1) / kTileSize * kTileSize;
    const int rows =
        int(std::min<std::uint64_t>(rowsThatFit, std::uint64_t(tileRows + 2 * reach))) - 2 * reach;
    if (rows < kTileSize)
        throw Error(
            ErrorCode::resources,
            fmt::format(
                "a memory budget of {} MiB is too small for a picture {} pixels wide; it needs {} MiB",
                memoryBytes >> 20, frame.width(),
                ((width * (kTileSize + 2 * reach) * groupSize * sizeof(vec4)) >> 20) + 1));
    const int bandRows = rows / kTileSize * kTileSize;

    Plan plan;
    plan.region = {frame.x0 - filter.reach.x, frame.y0 - reach, frame.x1 + filter.reach.x, frame.y1 + reach};
    for (int y = frame.y0; y < frame.y1; y += bandRows) {
        Band band;
        band.y0 = y;
        band.y1 = std::min(y + bandRows, frame.y1);
        band.region = {plan.region.x0, band.y0 - reach, plan.region.x1, band.y1 + reach};
        band.layout.regionOrigin = ivec2(band.region.x0, band.region.y0);
        band.layout.regionSize = ivec2(band.region.width(), band.region.height());
        band.layout.tileCount = (band.layout.regionSize + kTileSize - 1) / kTileSize;
        band.layout.outputsPerPixel = pattern.outputsPerPixel();
        band.layout.seed = seed;
        plan.bands.push_back(band);
        plan.outputs += band.region.area() * std::uint64_t(pattern.outputsPerPixel());
    }
    const std::uint64_t perGroup = plan.bands.front().region.area() * groupSize;
    plan.groupsPerChunk = int(std::clamp<std::uint64_t>(samples / perGroup, 1, pattern.groups.size()));
    return plan;
}

} // namespace slant
