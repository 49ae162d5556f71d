#include "reconstruct/shading_filter.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "lib/hash.glsl"
#include "lib/shading.glsl"
#include "reconstruct/kernels.h"
#include "reconstruct/layer_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace slant {
namespace {

/// How far the filters and averages of all bands reach together.
constexpr int kReach = (1 << kShadingBands) - 1 + (2 << kShadingBands) - 1 + kShadowReach;
/// What is blurred over more than this has little noise left.
constexpr float kMaxBlurPx = 128;
constexpr int kLeastRows = 8;

constexpr std::uint64_t kVec4PerSurfel = 2, kVec4PerPart = 10; // on the device; less on the CPU

} // namespace

vec4 surfaceOf(const LightField& field, std::size_t sample) {
    const vec3& normal = field.normal[sample];
    const float w = field.samples[sample].w;
    const bool shaded = std::isfinite(normal.x + normal.y + normal.z) && normal != vec3(0) && w > 0;
    const float nearness = shaded ? 1 / w : 0.f;
    return std::isfinite(nearness) && nearness > 0 ? vec4(normal, nearness) : vec4(0);
}

vec4 shadowRayOf(const LightField& field, std::size_t sample) {
    const vec3 &from = field.position[sample], to = field.light[sample] - from,
               free = field.blocker[sample] - from;
    const float whole = glm::dot(to, to), part = glm::dot(free, free);
    if (!(whole > 0) || !std::isfinite(whole + part + from.x + from.y + from.z)) return vec4(0);
    if (field.blocker[sample] == field.light[sample]) return vec4(from, kUnblocked);
    return vec4(from, std::clamp(std::sqrt(part / whole), std::numeric_limits<float>::min(), 1.f));
}

float shadingWeight(const LightField& field, std::size_t sample) {
    if (field.pixelStart.empty()) return 1;
    const LightFieldSample& s = field.samples[sample];
    const auto x = std::size_t(int(std::floor(s.x)) - field.bounds.x0),
               y = std::size_t(int(std::floor(s.y)) - field.bounds.y0);
    return 1 / float(field.samplesOf(y * std::size_t(field.bounds.width()) + x));
}

ShadingPlan planShading(const LightField& field, const GridLayout& grid, std::uint64_t bytes) {
    const Rect& region = field.frame;
    ShadingPlan plan{std::ranges::any_of(field.reflection, [](const vec3& v) { return v != vec3(0); }),
                     field.hasShadows(),
                     {}};
    // Whatever the focus, so that pictures do not depend on the one before.
    const vec2 extent = vec2(grid.brickCount * grid.cellsPerBrick) / grid.invCell;
    const vec2 low = glm::max(vec2(float(region.x0), float(region.y0)) - kMaxBlurPx, grid.origin),
               high = glm::min(vec2(float(region.x1), float(region.y1)) + kMaxBlurPx, grid.origin + extent);
    const ivec2 first = glm::floor(low), last = glm::max(ivec2(glm::ceil(high)), first + 1);
    const std::uint64_t rowBytes = std::uint64_t(last.x - first.x) * kSurfels * sizeof(vec4) *
                                   (kVec4PerSurfel + kVec4PerPart * (plan.reflects ? 2 : 1));
    const std::int64_t fitting = std::int64_t(bytes / rowBytes) - 2 * kReach;
    const int rows =
        int(std::clamp<std::int64_t>(fitting, std::min(kLeastRows, last.y - first.y), last.y - first.y));
    for (int y = first.y; y < last.y; y += rows) {
        const int above = std::max(first.y, y - kReach), end = std::min(last.y, y + rows);
        const int below = std::min(last.y, end + kReach);
        plan.bands.push_back(
            {{ivec2(first.x, above), ivec2(last.x - first.x, below - above)}, y - above, end - above});
    }
    return plan;
}

namespace {

/// Of a band, on the CPU.
template <bool kReflects>
class ShadingFilter {
public:
    ShadingFilter(Bins& bins, const SceneSideSamples& samples, const ShadingBand& band)
        : bins_(bins), samples_(samples), band_(band), size_(band.layout.size),
          surfels_(std::size_t(size_.x) * std::size_t(size_.y) * kSurfels), geometry_(surfels_, vec4(0)),
          slopes_(surfels_), means_(kParts * surfels_), changes_(kParts * surfels_),
          surfelOfRecord_(bins.positions.size(), kNoSurfel) {}

    void run() {
        std::vector<vec4> fine(2 * kParts * surfels_), coarse(fine.size());
        readSurfaces();
        sortByTexel();
        if (samples_.field().hasShadows()) soften();
        makeSurfels(fine);
        forEachSurfel([&](int surfel) {
            SlopeKernels kernels{geometry_};
            slopes_[std::size_t(surfel)] = vec2(kernels.slopeAlong(surfel, size_, ivec2(1, 0)),
                                                kernels.slopeAlong(surfel, size_, ivec2(0, 1)));
        });
        std::vector<vec3> details(kParts * surfels_), detailsBefore(details.size());
        std::vector<vec4> powers(kParts * surfels_);
        std::vector<vec2> smoothed(kParts * surfels_, vec2(0));
        for (int band = 0; band <= kShadingBands; ++band) {
            makeBand(band, fine, coarse, smoothed, details, powers);
            keepShares(band, powers, detailsBefore, smoothed);
            fine.swap(coarse);
            details.swap(detailsBefore);
        }
        apply();
    }

private:
    static constexpr std::size_t kParts = kReflects ? 2 : 1;

    vec3 lightOf(std::size_t sample, int part) const {
        if (part == 0 && !softened_.empty()) return softened_[sample];
        return samples_.value(part == 0 ? ValuePlane::illumination : ValuePlane::reflection, sample);
    }

    /// The shadow rays in the order of texels.
    struct SortedRays {
        std::vector<vec4> rays;
        std::vector<vec3> lights;
        std::vector<uint> ofTexels;
    };

    struct ShadowKernels {
        const ShadingFilter& filter;
        const SortedRays& sorted;

        uint texelStartAt(int texel) const { return filter.texelStart_[std::size_t(texel)]; }
        uint sampleInTexelAt(uint i) const { return filter.bins_.samples[filter.records_[i]]; }
        const vec4& rayAt(uint i) const { return sorted.rays[i]; }
        uint halfAt(uint i) const { return sampleInTexelAt(i) & 1u; }
        const vec3& lightPlaceAt(uint i) const { return sorted.lights[i]; }
        vec3 directAt(uint i) const { return filter.samples_.value(ValuePlane::direct, sampleInTexelAt(i)); }
        const vec4& normalAt(uint i) const { return filter.surfaces_[sampleInTexelAt(i)]; }
        uint raysOf(int texel) const { return sorted.ofTexels[std::size_t(texel)]; }
#include "lib/shadow_texels.glsl"
#include "lib/soft_shadows.glsl"
    };

    struct SurfelKernels {
        ShadingFilter& filter;

        uint recordAt(uint i) const { return filter.records_[i]; }
        uint sampleAt(uint record) const { return filter.bins_.samples[record]; }
        const vec4& surfaceAt(uint sample) const { return filter.surfaces_[sample]; }
        vec3 lightAt(uint sample, int part) const { return filter.lightOf(sample, part); }
        float weightAt(uint sample) const { return shadingWeight(filter.samples_.field(), sample); }
        void keepSurfelOf(uint record, uint surfel) { filter.surfelOfRecord_[record] = surfel; }
#include "lib/surfels.glsl"
    };

    struct SlopeKernels {
        const std::vector<vec4>& geometry;

        const vec4& geometryAt(int surfel) const { return geometry[std::size_t(surfel)]; }
#include "lib/shading_slopes.glsl"
    };

    struct BandKernels {
        const ShadingFilter& filter;
        const std::vector<vec4>& fine;

        const vec4& geometryAt(int surfel) const { return filter.geometry_[std::size_t(surfel)]; }
        const vec2& slopesAt(int surfel) const { return filter.slopes_[std::size_t(surfel)]; }
        const vec4& lightSumAt(int i) const { return fine[std::size_t(i)]; }
#include "lib/shading_bands.glsl"
    };

    struct GainKernels {
        const ShadingFilter& filter;
        const std::vector<vec4>& powers;

        const vec4& geometryAt(int surfel) const { return filter.geometry_[std::size_t(surfel)]; }
        const vec2& slopesAt(int surfel) const { return filter.slopes_[std::size_t(surfel)]; }
        const vec4& powersAt(int i) const { return powers[std::size_t(i)]; }
#include "lib/shading_gains.glsl"
    };

    template <typename Do>
    void forEachSurfel(const Do& act) const {
        parallelFor(0, surfels_, 1 << 10, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                if (geometry_[i].w > 0) act(int(i));
        });
    }

    void readSurfaces() {
        surfaces_.resize(samples_.field().samples.size());
        parallelFor(0, surfaces_.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) surfaces_[i] = surfaceOf(samples_.field(), i);
        });
    }

    void sortByTexel() {
        std::vector<uint> keys(bins_.positions.size());
        records_.resize(keys.size());
        for (std::size_t i = 0; i < keys.size(); ++i) {
            keys[i] = texelOf(band_.layout, vec2(bins_.positions[i]));
            records_[i] = uint(i);
        }
        const std::size_t texels = surfels_ / kSurfels;
        radixSort(keys, records_, keyBitsFor(uint(texels) + 1));
        texelStart_.resize(texels + 1);
        auto begin = keys.begin();
        for (std::size_t texel = 0; texel <= texels; ++texel) {
            begin = std::find_if(begin, keys.end(), [&](uint key) { return key >= texel; });
            texelStart_[texel] = uint(begin - keys.begin());
        }
    }

    SortedRays sortRays() const {
        const std::size_t count = texelStart_.back();
        SortedRays sorted{std::vector<vec4>(count), std::vector<vec3>(count),
                          std::vector<uint>(texelStart_.size() - 1)};
        forEachTexel([&](std::size_t texel) {
            ShadowKernels kernels{*this, sorted};
            const uint begin = texelStart_[texel], end = texelStart_[texel + 1];
            for (uint i = begin; i < end; ++i) {
                const uint sample = kernels.sampleInTexelAt(i);
                sorted.rays[i] = shadowRayOf(samples_.field(), sample);
                sorted.lights[i] = samples_.field().light[sample];
            }
            sorted.ofTexels[texel] = kernels.raysBetween(begin, end);
        });
        return sorted;
    }

    /// The illumination of the samples in texels, with the shadows that their neighbours see.
    void soften() {
        const SortedRays sorted = sortRays();
        std::vector<vec3> softened(samples_.field().samples.size());
        forEachTexel([&](std::size_t texel) {
            ShadowKernels kernels{*this, sorted};
            auto window = kernels.windowAround(int(texel), size_);
            for (uint i = texelStart_[texel]; i < texelStart_[texel + 1]; ++i) {
                const uint sample = kernels.sampleInTexelAt(i);
                softened[sample] = kernels.withSoftShadow(lightOf(sample, 0), window, i, hash(sample));
            }
        });
        softened_ = std::move(softened);
    }

    template <typename Do>
    void forEachTexel(const Do& act) const {
        parallelFor(0, surfels_ / kSurfels, 1 << 9, [&](std::size_t first, std::size_t last) {
            for (std::size_t texel = first; texel < last; ++texel) act(texel);
        });
    }

    void makeSurfels(std::vector<vec4>& light) {
        forEachTexel([&](std::size_t texel) { makeSurfels(texel, light); });
    }

    void makeSurfels(std::size_t texel, std::vector<vec4>& light) {
        const std::size_t first = texel * kSurfels;
        SurfelKernels kernels{*this};
        const auto found = kernels.surfelsOf(texelStart_[texel], texelStart_[texel + 1], uint(first));
        for (int layer = 0; layer < kSurfels; ++layer) {
            const std::size_t surfel = first + std::size_t(layer);
            geometry_[surfel] = kernels.meanGeometry(found, layer);
            for (int part = 0; part < int(kParts); ++part) {
                const vec4* const sums = found.light + lightIndex(layer, part, 0, true);
                vec4* const to = light.data() + lightIndex(int(surfel), part, 0, kReflects);
                to[0] = sums[0];
                to[1] = sums[1];
                means_[surfel * kParts + std::size_t(part)] = vec4(meanOf(sums[0] + sums[1]), 0);
            }
        }
    }

    /// The light through the filter of a band, and what that takes away; after the last band, only the powers
    /// of the one before.
    void makeBand(int band, const std::vector<vec4>& fine, std::vector<vec4>& coarse,
                  const std::vector<vec2>& smoothed, std::vector<vec3>& details, std::vector<vec4>& powers) {
        const bool last = band == kShadingBands;
        forEachSurfel([&](int surfel) {
            BandKernels kernels{*this, fine};
            const auto taps = last ? kernels.noTaps() : kernels.filtered(surfel, size_, 1 << band);
            for (int part = 0; part < int(kParts); ++part) {
                const std::size_t i = std::size_t(surfel) * kParts + std::size_t(part);
                const vec2 before = band > 0 ? smoothed[i] : vec2(0);
                if (last) {
                    powers[i] = vec4(0, 0, before);
                    continue;
                }
                const std::size_t sums = std::size_t(lightIndex(surfel, part, 0, kReflects));
                coarse[sums] = taps.light[2 * part];
                coarse[sums + 1] = taps.light[2 * part + 1];
                const Band found = bandOf(fine[sums], fine[sums + 1], coarse[sums], coarse[sums + 1]);
                details[i] = found.detail;
                powers[i] = vec4(found.covariance, found.variance, before);
            }
        });
    }

    void keepShares(int band, const std::vector<vec4>& powers, const std::vector<vec3>& detailsBefore,
                    std::vector<vec2>& smoothed) {
        forEachSurfel([&](int surfel) {
            GainKernels kernels{*this, powers};
            const auto taps = kernels.averaged(surfel, size_, 1 << band);
            for (int part = 0; part < int(kParts); ++part) {
                const std::size_t i = std::size_t(surfel) * kParts + std::size_t(part);
                const vec4 mean = taps.powers[part] / taps.weight;
                smoothed[i] = vec2(mean);
                if (band == 0) continue;
                changes_[i] = changedBy(band > 1 ? changes_[i] : vec4(0), detailsBefore[i],
                                        keptShare(mean.z, mean.w), band == 1);
            }
        });
    }

    void apply() {
        const ShadedPush push{size_, band_.firstRow, band_.lastRow, uint(bins_.positions.size())};
        parallelFor(0, bins_.positions.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
            for (std::size_t record = first; record < last; ++record) {
                const uint surfel = surfelOfRecord_[record];
                if (!isShaded(surfel, push)) continue;
                const std::size_t sample = bins_.samples[record], i = surfel * kParts;
                vec3 light = samples_.value(ValuePlane::illumination, sample);
                vec3 change = samples_.field().reflectance[sample] *
                              (filteredLight(lightOf(sample, 0), means_[i], changes_[i]) - light);
                if (kReflects) {
                    light = lightOf(sample, 1);
                    change += filteredLight(light, means_[i + 1], changes_[i + 1]) - light;
                }
                vec4& value = bins_.values[record];
                value = vec4(glm::max(vec3(value) + change, vec3(0)), value.w);
            }
        });
    }

    Bins& bins_;
    const SceneSideSamples& samples_;
    const ShadingBand& band_;
    ivec2 size_;
    std::size_t surfels_;
    std::vector<vec4> surfaces_; ///< of each sample
    std::vector<vec4> geometry_;
    std::vector<vec2> slopes_;
    std::vector<vec4> means_, changes_; ///< of each surfel, part after part
    std::vector<uint> surfelOfRecord_;
    std::vector<uint> records_, texelStart_; ///< in the order of their texels; first of each, and of one more
    std::vector<vec3> softened_;             ///< illumination of each sample; empty without shadow rays
};

} // namespace

void filterShading(Bins& bins, const SceneSideSamples& samples, const ShadingPlan& plan) {
    for (const ShadingBand& band : plan.bands)
        if (plan.reflects)
            ShadingFilter<true>(bins, samples, band).run();
        else
            ShadingFilter<false>(bins, samples, band).run();
}

} // namespace slant
