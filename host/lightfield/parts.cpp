#include "lightfield/parts.h"

#include "base/parallel.h"

#include <algorithm>

namespace slant {
namespace {

constexpr std::size_t kPixelsAtOnce = 1 << 10;

/// The field without its samples.
LightField emptyLike(const LightField& field) {
    return {{}, field.bounds, field.frame, 0, field.slopeModel, field.aperture, field.lensMap, {}};
}

/// Makes room for `counts` samples of each pixel of a field that has none.
void allocate(LightField& field, std::span<const std::uint32_t> counts, SamplePlanes planes) {
    setSampleCounts(field, counts);
    field.resize(field.firstSample(counts.size()), planes);
}

/// The first sample of a pixel that is in a half.
std::size_t firstOfHalf(const LightField& field, std::size_t pixel, int half) {
    const auto width = std::size_t(field.bounds.width());
    return (pixel % width + pixel / width + std::size_t(half)) % 2;
}

} // namespace

void copySamples(const SampleSet& from, std::size_t source, SampleSet& to, std::size_t target,
                 std::size_t count) {
    std::copy_n(from.samples.data() + source, count, to.samples.data() + target);
    for (const auto plane : kValuePlanes)
        if (!(from.*plane).empty())
            std::copy_n((from.*plane).data() + source, count, (to.*plane).data() + target);
}

LightField halfOf(const LightField& field, int half) {
    const std::size_t pixels = field.bounds.area();
    std::vector<std::uint32_t> counts(pixels);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        counts[pixel] = std::uint32_t((field.samplesOf(pixel) + 1 - firstOfHalf(field, pixel, half)) / 2);
    LightField part = emptyLike(field);
    allocate(part, counts, field.planes());
    parallelFor(0, pixels, kPixelsAtOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t pixel = first; pixel < last; ++pixel) {
            std::size_t source = field.firstSample(pixel) + firstOfHalf(field, pixel, half);
            for (std::size_t to = part.firstSample(pixel); to < part.firstSample(pixel + 1);
                 ++to, source += 2)
                copySamples(field, source, part, to, 1);
        }
    });
    return part;
}

void addSamples(LightField& field, const LightField& more) {
    const std::size_t pixels = field.bounds.area(), width = std::size_t(field.bounds.width());
    const auto pixelOfMore = [&](std::size_t pixel) -> std::ptrdiff_t {
        const int x = field.bounds.x0 + int(pixel % width), y = field.bounds.y0 + int(pixel / width);
        return more.bounds.contains(x, y)
                   ? std::ptrdiff_t(y - more.bounds.y0) * more.bounds.width() + (x - more.bounds.x0)
                   : -1;
    };
    std::vector<std::uint32_t> counts(pixels);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const std::ptrdiff_t other = pixelOfMore(pixel);
        counts[pixel] =
            std::uint32_t(field.samplesOf(pixel) + (other < 0 ? 0 : more.samplesOf(std::size_t(other))));
    }
    SamplePlanes planes = field.planes();
    planes.motion = planes.motion || more.moves();
    LightField both = emptyLike(field);
    allocate(both, counts, planes);
    parallelFor(0, pixels, kPixelsAtOnce, [&](std::size_t first, std::size_t last) {
        for (std::size_t pixel = first; pixel < last; ++pixel) {
            const std::size_t target = both.firstSample(pixel), before = field.samplesOf(pixel);
            copySamples(field, field.firstSample(pixel), both, target, before);
            const std::ptrdiff_t other = pixelOfMore(pixel);
            if (other >= 0)
                copySamples(more, more.firstSample(std::size_t(other)), both, target + before,
                            more.samplesOf(std::size_t(other)));
        }
    });
    field = std::move(both);
}

} // namespace slant
