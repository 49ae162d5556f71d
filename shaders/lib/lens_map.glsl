// Where a compound lens sends its rays, which host/camera/lens_map.h explains.
//
// Needs, declared before the include: lensMapAt(int), which reads the texels of the map. In C++ it is
// included in a struct that has that.
#include "shared/lens_map.h"
#include "shared/kernel.h"

KERNEL vec4 lensMapAlong(int index, float part) {
    const vec4 a = lensMapAt(index);
    return a + part * (lensMapAt(index + 1) - a);
}

KERNEL vec4 lensMapInRing(int index, int row, float part, float between) {
    const vec4 a = lensMapAlong(index, part);
    return a + between * (lensMapAlong(index + row, part) - a);
}

struct LensMapPlace {
    int row, plane;             // from a node to the next turn, the next ring
    float part, between, rings; // towards the next distance, turn, ring
};

KERNEL vec4 lensMapInPlace(int index, IN(LensMapPlace) place) {
    const vec4 a = lensMapInRing(index, place.row, place.part, place.between);
    return a + place.rings * (lensMapInRing(index + place.plane, place.row, place.part, place.between) - a);
}

/// From film and pupil, `lens` in the unit disc, to the scene's side.
KERNEL SceneRay sceneRay(vec2 raster, vec2 lens) {
    const vec4 head = lensMapAt(0), shape = lensMapAt(1);
    const vec2 offset = raster - vec2(head);
    const float r = sqrt(offset.x * offset.x + offset.y * offset.y);
    const float radii = r * head.z;
    SceneRay place = {vec2(0.0f), vec2(0.0f), vec3(0.0f), vec2(0.0f), 0.0f, 0.0f};
    if (!(radii < head.w - 1.0f)) return place;
    const int radius = int(radii);
    const vec4 here = lensMapAlong(kLensMapHeader + radius, radii - float(radius));
    if (!(here.w > 0.0f)) return place;

    // In the frame of the radius.
    const vec2 e = r > 0.0f ? offset / r : vec2(1.0f, 0.0f);
    const vec2 d = vec2(lens.x * e.x + lens.y * e.y, lens.y * e.x - lens.x * e.y);
    const float rings = min(r * shape.x, shape.y - 1.0f);
    const int ring = min(int(rings), int(shape.y) - 2);
    const float norm = abs(d.x) + abs(d.y);
    const float turns = norm > 0.0f ? (1.0f - d.x / norm) * (shape.z * 0.5f) : 0.0f;
    const int turn = min(int(turns), int(shape.z) - 1);
    const float distances = min(sqrt(d.x * d.x + d.y * d.y), 1.0f) * shape.w;
    const int distance_ = min(int(distances), int(shape.w) - 1);

    const int row = int(shape.w) + 1, plane = row * (int(shape.z) + 1);
    const int first = kLensMapHeader + int(head.w) + ring * plane + turn * row + distance_;
    const LensMapPlace at = {row, plane, distances - float(distance_), turns - float(turn),
                             rings - float(ring)};
    const vec4 node = lensMapInPlace(first, at);
    place.weight = here.w;
    place.openShare = 1.0f;
    if (lensMapAt(2).x > 0.0f) {
        const vec4 light = lensMapInPlace(first + plane * int(shape.y), at);
        place.weight = light.y >= 0.0f ? light.x : 0.0f;
        place.openShare = light.z;
    }

    const float side = d.y < 0.0f ? -1.0f : 1.0f;
    const vec2 x = vec2(here.x + here.y * node.x, here.z * (side * node.y)), u = vec2(node.z, side * node.w);
    place.xy = vec2(head) + vec2(x.x * e.x - x.y * e.y, x.x * e.y + x.y * e.x);
    place.uv = vec2(u.x * e.x - u.y * e.y, u.x * e.y + u.y * e.x);
    const float along = 1.0f / here.y, across = 1.0f / here.z;
    place.filmMetric = vec3(across + e.x * e.x * (along - across), e.x * e.y * (along - across),
                            across + e.y * e.y * (along - across));
    const float skew = abs(e.x * e.y * (here.y - here.z));
    place.extent =
        vec2(here.z + e.x * e.x * (here.y - here.z) + skew, here.z + e.y * e.y * (here.y - here.z) + skew);
    return place;
}
