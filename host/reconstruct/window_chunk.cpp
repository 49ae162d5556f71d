#include "reconstruct/window_chunk.h"

#include "base/parallel.h"

#include <fmt/format.h>
#include <mutex>

namespace slant {
namespace {

constexpr std::size_t kOutputsPerPiece = 512;

void addTo(ReconstructReport& report, const std::array<std::uint64_t, 4>& counts) {
    report.visibility += counts[std::size_t(WindowOutcome::parted)];
    report.widened += counts[std::size_t(WindowOutcome::filled)];
    report.holes += counts[std::size_t(WindowOutcome::hole)];
}

} // namespace

WindowChunk::WindowChunk(const WindowSamples& samples, const WindowSearch& search, const LensMap& lens,
                         const OutputPattern& pattern, const Band& band, std::uint64_t seed,
                         std::size_t firstGroup, std::size_t groupCount)
    : samples_(samples), search_(search), lens_(lens), pattern_(pattern),
      layout_(layoutOf(band, pattern, seed)), firstOutput_(int(firstGroup) << pattern.groupBits) {
    dense.region = band.region;
    dense.samples.resize(band.region.area() * (groupCount << pattern.groupBits));
}

/// The outputs indexAt(0), ..., indexAt(count - 1).
template <typename IndexAt>
WindowChunk::Counts WindowChunk::look(std::size_t count, const IndexAt& indexAt, Monitor* monitor) {
    const std::size_t area = dense.region.area(), width = std::size_t(layout_.regionSize.x);
    Counts counts{};
    std::mutex mutex;
    parallelFor(0, count, kOutputsPerPiece, [&](std::size_t first, std::size_t last) {
        std::vector<WindowCandidate> scratch;
        Counts part{};
        for (std::size_t i = first; i < last; ++i) {
            const std::size_t index = indexAt(i), place = index % area;
            const ivec2 pixel = layout_.regionOrigin + ivec2(int(place % width), int(place / width));
            const int k = firstOutput_ + int(index / area);
            Output output = outputAt(pixel, k, pattern_, layout_.seed);
            if (!lens_.empty()) toSceneSide(lens_, output);
            const WindowResult result = output.weight > 0
                                            ? lookThroughWindow(samples_, search_, pixel, output, scratch)
                                            : WindowResult{WindowOutcome::found};
            dense.samples[index] = vec4(output.weight * result.rgb, output.positionCode);
            ++part[std::size_t(result.outcome)];
        }
        if (monitor) monitor->advance(last - first);
        const std::lock_guard lock(mutex);
        for (std::size_t i = 0; i < part.size(); ++i) counts[i] += part[i];
    });
    return counts;
}

void WindowChunk::run(Monitor& monitor, ReconstructReport& report) {
    addTo(report, look(
                      dense.samples.size(), [](std::size_t i) { return i; }, &monitor));
    report.outputs += dense.samples.size();
}

void WindowChunk::redo(std::span<const uint> indices, ReconstructReport& report) {
    addTo(report, look(
                      indices.size(), [&](std::size_t i) { return std::size_t(indices[i]); }, nullptr));
}

void warnOfHoles(const ReconstructReport& report, Monitor& monitor) {
    if (report.holes > 0)
        monitor.warn(fmt::format("{} of {} outputs are black: nothing in their windows", report.holes,
                                 report.outputs));
}

} // namespace slant
