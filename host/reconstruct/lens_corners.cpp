#include "reconstruct/lens_corners.h"

#include "base/parallel.h"
#include "reconstruct/kernels.h"

namespace slant {
namespace {

struct PixelKernels {
    const std::vector<vec4>& lensMap;

    const vec4& lensMapAt(int i) const { return lensMap[std::size_t(i)]; }
#include "lib/lens_map.glsl"

#include "lib/pixel_sight.glsl"
};

struct CornerKernels {
    const LensCorners& corners;

    const vec4& cornerRayAt(int i) const { return corners.rays[std::size_t(i)]; }
#include "lib/lens_corners.glsl"
};

} // namespace

LensCorners lensCorners(const LensMap& lens, const OutputLayout& layout, std::span<const vec4> points) {
    const ivec2 count = layout.tileCount + 1;
    const std::size_t plane = std::size_t(count.x) * std::size_t(count.y);
    LensCorners corners;
    corners.rays.resize(points.size() * plane);
    parallelFor(0, points.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first * plane; i < last * plane; ++i) {
            const ivec2 corner(int(i % plane) % count.x, int(i % plane) / count.x);
            const LensNode node =
                lens.nodeAt(vec2(layout.regionOrigin + kTileSize * corner), vec2(points[i / plane]));
            corners.rays[i] = node.node;
        }
    });
    return corners;
}

PixelSight pixelSight(const LensMap& lens, const OutputLayout& layout, ivec2 position) {
    const vec2 middle = vec2(layout.regionOrigin + position) + 0.5f;
    return PixelKernels{lens.texels()}.pixelSight(position, middle, layout.tileCount);
}

void lookFromCorners(const LensCorners& corners, const PixelSight& sight, int plane, vec2 fromMiddle,
                     Output& output) {
    CornerKernels{corners}.lookFromCorners(sight, plane, fromMiddle, output);
}

} // namespace slant
