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
                                              const ShadingPlan& plan) {
    const LightField& field = samples.field();
    const std::size_t count = field.samples.size(), rays = plan.shadows ? count : 0;
    const auto light = [&](ValuePlane plane, std::size_t of) {
        return sampleBuffer(device, of,
                            [&, plane](std::size_t i) { return vec4(samples.value(plane, i), 0); });
    };
    return {sampleBuffer(device, count, [&](std::size_t i) { return surfaceOf(field, i); }),
            light(ValuePlane::illumination, count),
            sampleBuffer(device, count,
                         [&](std::size_t i) { return vec4(field.reflectance[i], shadingWeight(field, i)); }),
            light(ValuePlane::reflection, plan.reflects ? count : 0),
            sampleBuffer(device, rays, [&](std::size_t i) { return shadowRayOf(field, i); }),
            sampleBuffer(device, rays, [&](std::size_t i) { return vec4(field.light[i], 0); }),
            light(ValuePlane::direct, rays),
            Buffer(device, TexelFormat::rgba32f, rays)};
}

ShadingPasses::ShadingPasses(Device& device, const SceneSideSamples& samples, const ShadingPlan& plan)
    : device_(device), parts_(plan.reflects ? 2 : 1),
      shadows_(plan.shadows), constants_{plan.reflects ? 1u : 0u}, texels_(device, "shading_texels"),
      start_(device, "list_start"), rays_(device, "shading_rays"), softShadows_(device, "shading_shadows"),
      surfels_(device, "shading_surfels", constants_), slopes_(device, "shading_slopes"),
      bands_(device, "shading_bands", constants_), gains_(device, "shading_gains", constants_),
      apply_(device, "shading_apply", constants_), inputs_(inputsOf(device, samples, plan)) {}

void ShadingPasses::soften(CommandList& commands, const DeviceBins& bins, const Texels& texels,
                           ivec2 size) const {
    const std::uint64_t count = std::uint64_t(size.x) * std::uint64_t(size.y),
                        records = bins.grid.sampleCount;
    Buffer rays(device_, TexelFormat::rgba32f, records), lights(device_, TexelFormat::rgba32f, records),
        ofTexels(device_, TexelFormat::r32ui, count);
    const ShadingPush push{size, 0};
    const Grid grid = softShadows_.gridFor(count);
    commands.dispatch(
        rays_,
        {texels.start, texels.records, bins.samples, inputs_.rays, inputs_.lights, rays, lights, ofTexels},
        push, grid);
    commands.dispatch(softShadows_,
                      {texels.start, texels.records, bins.samples, inputs_.surfaces, rays, lights,
                       inputs_.direct, inputs_.illumination, ofTexels, inputs_.softened},
                      push, grid);
    commands.run();
}

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
    if (shadows_) soften(commands, bins, {start, sorted.values}, layout.size);
    commands.fill(surfels.ofRecords, kNoSurfel);
    commands.dispatch(surfels_,
                      {start, sorted.values, bins.samples, inputs_.surfaces, illumination(),
                       inputs_.reflection, inputs_.reflectance, surfels.ofRecords, surfels.geometry,
                       surfels.fine, surfels.means},
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
                      {bins.samples, s.ofRecords, inputs_.illumination, illumination(), inputs_.reflectance,
                       inputs_.reflection, s.means, s.changes, bins.values},
                      push, apply_.gridFor(push.count));
    commands.run();
}

} // namespace slant
