#include "compute/shading_passes.h"

#include "base/sort.h"
#include "compute/field_buffers.h"

#include <utility>

namespace slant {

struct ShadingPasses::Surfels {
    Buffer ofRecords, geometry, slopes, means, fine, coarse, details, detailsBefore, powers, smoothed,
        changes;

    Surfels(Device& device, std::uint64_t records, std::uint64_t surfels, std::uint64_t parts)
        : ofRecords(device, TexelFormat::r32ui, records), geometry(device, TexelFormat::rgba32f, surfels),
          slopes(device, TexelFormat::rgba32f, surfels), means(device, TexelFormat::rgba32f, parts * surfels),
          fine(device, TexelFormat::rgba32f, 2 * parts * surfels),
          coarse(device, TexelFormat::rgba32f, 2 * parts * surfels),
          details(device, TexelFormat::rgba32f, parts * surfels),
          detailsBefore(device, TexelFormat::rgba32f, parts * surfels),
          powers(device, TexelFormat::rgba32f, parts * surfels),
          smoothed(device, TexelFormat::rgba32f, parts * surfels),
          changes(device, TexelFormat::rgba32f, parts * surfels) {}
};

ShadingPasses::Inputs ShadingPasses::inputsOf(Device& device, const SceneSideSamples& samples,
                                              bool reflects) {
    const LightField& field = samples.field();
    const std::size_t count = field.samples.size();
    const auto light = [&](ValuePlane plane, std::size_t of) {
        return sampleBuffer(device, of,
                            [&, plane](std::size_t i) { return vec4(samples.value(plane, i), 0); });
    };
    return {sampleBuffer(device, count, [&](std::size_t i) { return surfaceOf(field, i); }),
            light(ValuePlane::illumination, count),
            sampleBuffer(device, count, [&](std::size_t i) { return vec4(field.reflectance[i], 0); }),
            light(ValuePlane::reflection, reflects ? count : 0)};
}

ShadingPasses::ShadingPasses(Device& device, const SceneSideSamples& samples, bool reflects)
    : device_(device), parts_(reflects ? 2 : 1), constants_{reflects ? 1u : 0u},
      texels_(device, "shading_texels"), start_(device, "list_start"),
      surfels_(device, "shading_surfels", constants_), slopes_(device, "shading_slopes"),
      bands_(device, "shading_bands", constants_), gains_(device, "shading_gains", constants_),
      apply_(device, "shading_apply", constants_), inputs_(inputsOf(device, samples, reflects)) {}

void ShadingPasses::makeSurfels(CommandList& commands, const DeviceBins& bins, const ShadingBand& band,
                                const Surfels& surfels) const {
    const ShadingLayout& layout = band.layout;
    const uint records = bins.grid.sampleCount, texels = uint(layout.size.x) * uint(layout.size.y);
    PairBuffers pairs(device_, records), scratch(device_, records);
    commands.dispatch(texels_, {bins.positions, pairs.keys, pairs.values}, TexelPush{layout, records},
                      texels_.gridFor(records));
    RadixSort sort(device_, records);
    const PairBuffers& sorted = sort.record(commands, pairs, scratch, records, keyBitsFor(texels + 1));
    Buffer start(device_, TexelFormat::r32ui, texels + 1);
    commands.dispatch(start_, {sorted.keys, start}, LowerBoundPush{records, texels + 1},
                      start_.gridFor(texels + 1));
    commands.fill(surfels.ofRecords, kNoSurfel);
    commands.dispatch(surfels_,
                      {start, sorted.values, bins.samples, inputs_.surfaces, inputs_.illumination,
                       inputs_.reflection, surfels.ofRecords, surfels.geometry, surfels.fine, surfels.means},
                      ShadingPush{layout.size, 0}, surfels_.gridFor(texels));
    commands.run();
}

void ShadingPasses::run(CommandList& commands, const DeviceBins& bins, const ShadingBand& band) const {
    const ivec2 size = band.layout.size;
    const std::uint64_t count = std::uint64_t(size.x) * std::uint64_t(size.y) * kSurfels;
    Surfels s(device_, bins.grid.sampleCount, count, parts_);
    makeSurfels(commands, bins, band, s);
    const Grid grid = bands_.gridFor(count);
    commands.dispatch(slopes_, {s.geometry, s.slopes}, ShadingPush{size, 0}, grid);
    Buffer *fine = &s.fine, *coarse = &s.coarse, *details = &s.details, *before = &s.detailsBefore;
    for (int i = 0; i <= kShadingBands; ++i) {
        const ShadingPush push{size, i};
        commands.dispatch(bands_, {s.geometry, s.slopes, *fine, *coarse, s.smoothed, *details, s.powers},
                          push, grid);
        commands.dispatch(gains_, {s.geometry, s.slopes, s.powers, *before, s.smoothed, s.changes}, push,
                          grid);
        std::swap(fine, coarse);
        std::swap(details, before);
    }
    const ShadedPush push{size, band.firstRow, band.lastRow, bins.grid.sampleCount};
    commands.dispatch(apply_,
                      {bins.samples, s.ofRecords, inputs_.illumination, inputs_.reflectance,
                       inputs_.reflection, s.means, s.changes, bins.values},
                      push, apply_.gridFor(push.count));
    commands.run();
}

} // namespace slant
