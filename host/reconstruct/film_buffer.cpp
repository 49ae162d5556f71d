#include "reconstruct/film_buffer.h"

#include "base/parallel.h"
#include "reconstruct/kernels.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

struct FilmKernels {
    const FilterTable& filter;

    float filterWeightAt(int i) const { return filter.weights[std::size_t(i)]; }
#include "lib/film.glsl"
};

/// Weight of a sample that stands for all places in the pixel `offset` pixels away.
float meanWeight(const FilterTable& filter, ivec2 offset) {
    const float* means = filter.weights.data() + filter.length.x + filter.length.y;
    return means[glm::abs(offset.x)] * means[filter.reach.x + 1 + glm::abs(offset.y)];
}

/// Adds what a group of `size` samples, one plane apart, contributes to the pixel that sees their pixel
/// `offset` pixels away.
void addGroup(vec4& sum, const FilterTable& filter, const vec4* sample, std::size_t plane, int size,
              ivec2 offset) {
    FilmKernels kernels{filter};
    if (sample->w == kWholePixel) {
        sum += kernels.weighted(*sample, float(size) * meanWeight(filter, offset));
        return;
    }
    int leftOut = 0;
    for (int k = 0; k < size; ++k) leftOut += sample[std::size_t(k) * plane].w == kLeftOut;
    const float scale = float(size) / float(size - leftOut);
    for (int k = 0; k < size; ++k) {
        const vec4& own = sample[std::size_t(k) * plane];
        if (own.w < 0) continue;
        const int code = int(own.w);
        sum += kernels.weighted(
            own, scale * (kernels.axisWeight(0, filter.length.x, offset.x, code / kSubpixels) *
                          kernels.axisWeight(filter.length.x, filter.length.y, offset.y, code % kSubpixels)));
    }
}

} // namespace

float positionCode(float fractionX, float fractionY) {
    const int qx = std::clamp(int(fractionX * kSubpixels), 0, kSubpixels - 1);
    const int qy = std::clamp(int(fractionY * kSubpixels), 0, kSubpixels - 1);
    return float(qx * kSubpixels + qy);
}

FilmBuffer::FilmBuffer(const Rect& frame, FilterTable filter)
    : frame_(frame), filter_(std::move(filter)), sums_(frame.area(), vec4(0)) {}

vec4 FilmBuffer::partOf(const DenseSamples& dense, int x, int y, int begin, int end) const {
    const std::size_t plane = dense.region.area();
    const ivec2 reach = filter_.reach;
    vec4 part(0);
    for (int dy = -reach.y; dy <= reach.y; ++dy)
        for (int dx = -reach.x; dx <= reach.x; ++dx) {
            const vec4* sample = dense.samples.data() +
                                 std::size_t(y + dy - dense.region.y0) * dense.region.width() +
                                 (x + dx - dense.region.x0);
            vec4 sum(0);
            for (int group = begin; group < end; group += dense.groupSize)
                addGroup(sum, filter_, sample + group * plane, plane, dense.groupSize, ivec2(dx, dy));
            part += sum;
        }
    return part;
}

void FilmBuffer::accumulate(const DenseSamples& dense, int y0, int y1) {
    const int planes = int(dense.samples.size() / std::max<std::size_t>(dense.region.area(), 1));
    parallelFor(std::size_t(y0 - frame_.y0), std::size_t(y1 - frame_.y0), 1,
                [&](std::size_t first, std::size_t last) {
                    for (int y = int(first) + frame_.y0; y < int(last) + frame_.y0; ++y)
                        for (int x = frame_.x0; x < frame_.x1; ++x) {
                            vec4& sum = sums_[std::size_t(y - frame_.y0) * frame_.width() + (x - frame_.x0)];
                            for (int block = 0; block < planes; block += kFilmBlock)
                                sum += partOf(dense, x, y, block, std::min(block + kFilmBlock, planes));
                        }
                });
}

Image filmImage(const Rect& frame, const std::vector<vec4>& sums, std::uint64_t& emptyPixels) {
    Image image(frame, {"R", "G", "B"});
    emptyPixels = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const bool empty = !(sums[i].w > 0);
        emptyPixels += empty;
        for (int c = 0; c < 3; ++c) image.pixels[3 * i + std::size_t(c)] = empty ? 0 : sums[i][c] / sums[i].w;
    }
    return image;
}

namespace {

/// `valueAt` gives the value of a sample by its index.
template <typename ValueAt>
DenseSamples densePlanes(const LightField& field, const Rect& region, const ValueAt& valueAt) {
    const std::size_t planes = sampleCounts(field).max;
    DenseSamples dense{region, std::vector<vec4>(region.area() * planes, vec4(0, 0, 0, -1))};
    parallelFor(0, std::size_t(region.height()), 1, [&](std::size_t first, std::size_t last) {
        for (int j = int(first); j < int(last); ++j)
            for (int i = 0; i < region.width(); ++i) {
                const int x = region.x0 + i, y = region.y0 + j;
                if (!field.bounds.contains(x, y)) continue;
                const std::size_t pixel = std::size_t(y - field.bounds.y0) * field.bounds.width() +
                                          std::size_t(x - field.bounds.x0);
                const std::size_t count = field.samplesOf(pixel);
                // Chance decides which samples repeat once more than others.
                const std::size_t turn = count < planes ? hash(uint(pixel)) : 0;
                for (std::size_t k = 0; count > 0 && k < planes; ++k) {
                    const std::size_t sample = field.firstSample(pixel) + (k + turn) % count;
                    const LightFieldSample& s = field.samples[sample];
                    if (std::isnan(s.slope)) continue; // disabled by sanitize
                    dense.samples[k * region.area() + std::size_t(j) * region.width() + i] =
                        vec4(valueAt(sample), positionCode(s.x - float(x), s.y - float(y)));
                }
            }
    });
    return dense;
}

} // namespace

DenseSamples denseFromInput(const LightField& field, ValuePlane plane, const Rect& region) {
    return densePlanes(field, region, [&](std::size_t i) { return valueOf(field, plane, i); });
}

DenseSamples denseFromInput(const LightField& field, std::span<const vec3> values, const Rect& region) {
    return densePlanes(field, region, [&](std::size_t i) { return values[i]; });
}

} // namespace slant
