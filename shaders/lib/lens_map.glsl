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

/// A place of the film.
struct FilmPlace {
    vec2 centre; // of the film
    float r;     // from there
    vec2 e;      // direction of the radius
    bool inside; // false: beyond the map
    vec4 here;   // of the radii
};

KERNEL FilmPlace filmPlace(vec2 raster) {
    const vec4 head = lensMapAt(0);
    const vec2 offset = raster - vec2(head);
    const float r = sqrt(offset.x * offset.x + offset.y * offset.y);
    const float radii = r * head.z;
    const bool inside = radii < head.w - 1.0f;
    const int radius = inside ? int(radii) : 0;
    const vec4 here = lensMapAlong(kLensMapHeader + radius, radii - float(radius));
    const FilmPlace place = {vec2(head), r, r > 0.0f ? offset / r : vec2(1.0f, 0.0f), inside, here};
    return place;
}

/// From the frame of the radius to that of the film.
KERNEL vec2 turned(IN(FilmPlace) film, vec2 x) {
    return vec2(x.x * film.e.x - x.y * film.e.y, x.x * film.e.y + x.y * film.e.x);
}

/// In the frame of the radius.
KERNEL LensNode lensNode(IN(FilmPlace) film, vec2 lens) {
    const vec4 head = lensMapAt(0), shape = lensMapAt(1);
    const vec2 e = film.e;
    const vec2 d = vec2(lens.x * e.x + lens.y * e.y, lens.y * e.x - lens.x * e.y);
    const float rings = min(film.r * shape.x, shape.y - 1.0f);
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
    LensNode found = {lensMapInPlace(first, at), vec4(0.0f)};
    const float side = d.y < 0.0f ? -1.0f : 1.0f;
    found.node.y *= side;
    found.node.w *= side;
    if (lensMapAt(2).x > 0.0f) found.light = lensMapInPlace(first + plane * int(shape.y), at);
    return found;
}

/// From film and pupil, `lens` in the unit disc, to the scene's side.
KERNEL SceneRay sceneRay(IN(FilmPlace) film, vec2 lens) {
    SceneRay place = {vec2(0.0f), vec2(0.0f), vec3(0.0f), vec2(0.0f), 0.0f, 0.0f};
    const vec4 here = film.here;
    if (!(film.inside && here.w > 0.0f)) return place;
    const LensNode found = lensNode(film, lens);
    const vec4 node = found.node;
    const bool ofStop = lensMapAt(2).x > 0.0f;
    place.weight = !ofStop ? here.w : found.light.y >= 0.0f ? found.light.x : 0.0f;
    place.openShare = ofStop ? found.light.z : 1.0f;
    place.xy = film.centre + turned(film, vec2(here.x + here.y * node.x, here.z * node.y));
    place.uv = turned(film, vec2(node.z, node.w));
    const vec2 e = film.e;
    const float along = 1.0f / here.y, across = 1.0f / here.z;
    place.filmMetric = vec3(across + e.x * e.x * (along - across), e.x * e.y * (along - across),
                            across + e.y * e.y * (along - across));
    const float skew = abs(e.x * e.y * (here.y - here.z));
    place.extent =
        vec2(here.z + e.x * e.x * (here.y - here.z) + skew, here.z + e.y * e.y * (here.y - here.z) + skew);
    return place;
}
KERNEL SceneRay sceneRay(vec2 raster, vec2 lens) {
    return sceneRay(filmPlace(raster), lens);
}
