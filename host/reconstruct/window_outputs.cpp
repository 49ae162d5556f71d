#include "reconstruct/window_outputs.h"

#include "base/parallel.h"

#include <array>
#include <mutex>

namespace slant {
namespace {

constexpr std::size_t kOutputsPerPiece = 512;

} // namespace

WindowOutputs::WindowOutputs(const WindowSamples& samples, const WindowSearch& search, const LensMap& lens,
                             const OutputPattern& pattern, const Chunk& chunk)
    : samples_(samples), search_(search), lens_(lens), pattern_(pattern), chunk_(chunk) {
    dense.region = chunk.band.region;
    dense.samples.resize(chunk.outputs());
}

/// The outputs indexAt(0), ..., indexAt(count - 1).
template <typename IndexAt>
SearchCounts WindowOutputs::lookAt(std::size_t count, const IndexAt& indexAt, Monitor& monitor) {
    const OutputLayout& layout = chunk_.layout;
    const std::size_t area = dense.region.area(), width = std::size_t(layout.regionSize.x);
    std::array<std::uint64_t, 4> counts{}; // of each WindowOutcome
    std::mutex mutex;
    parallelFor(0, count, kOutputsPerPiece, [&](std::size_t first, std::size_t last) {
        std::vector<WindowCandidate> scratch;
        std::array<std::uint64_t, 4> part{};
        for (std::size_t i = first; i < last; ++i) {
            const std::size_t index = indexAt(i), place = index % area;
            const ivec2 pixel = layout.regionOrigin + ivec2(int(place % width), int(place / width));
            const int k = chunk_.firstOutput + int(index / area);
            Output output = outputAt(pixel, k, pattern_, layout.seed);
            if (!lens_.empty()) toSceneSide(lens_, output);
            const WindowResult result = output.weight > 0
                                            ? lookThroughWindow(samples_, search_, pixel, output, scratch)
                                            : WindowResult{WindowOutcome::found};
            dense.samples[index] = vec4(output.weight * result.rgb, output.positionCode);
            ++part[std::size_t(result.outcome)];
        }
        monitor.advance(last - first);
        const std::lock_guard lock(mutex);
        for (std::size_t i = 0; i < part.size(); ++i) counts[i] += part[i];
    });
    SearchCounts result;
    result.visibility = counts[std::size_t(WindowOutcome::parted)];
    result.widened = counts[std::size_t(WindowOutcome::filled)];
    result.holes = counts[std::size_t(WindowOutcome::hole)];
    return result;
}

SearchCounts WindowOutputs::look(Monitor& monitor) {
    return lookAt(
        dense.samples.size(), [](std::size_t i) { return i; }, monitor);
}

SearchCounts WindowOutputs::redo(std::span<const uint> indices) {
    SilentMonitor silent;
    return lookAt(
        indices.size(), [&](std::size_t i) { return std::size_t(indices[i]); }, silent);
}

} // namespace slant
