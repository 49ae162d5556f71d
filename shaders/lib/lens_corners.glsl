// Where outputs look through a compound lens, from what is known at the corners of their tile
// (host/reconstruct/lens_corners.h): a tenth of what lib/lens_map.glsl takes.
//
// Needs, declared before the include: cornerRayAt(int), which reads the corners. In C++ it is included in a
// struct that has it, after lib/output.glsl.
#include "lib/output.glsl"

KERNEL vec4 betweenCorners(vec4 a, vec4 b, vec4 c, vec4 d, vec2 part) {
    const vec4 above = a + part.x * (b - a), below = c + part.x * (d - c);
    return above + part.y * (below - above);
}

/// Takes the output `plane` of a pixel to the scene's side; `fromMiddle` is where it lies in its pixel.
KERNEL void lookFromCorners(IN(PixelSight) sight, int plane, vec2 fromMiddle, INOUT(Output) o) {
    const int i = sight.corner + plane * sight.plane, below = i + sight.row;
    const vec4 ray = betweenCorners(cornerRayAt(i), cornerRayAt(i + 1), cornerRayAt(below),
                                    cornerRayAt(below + 1), sight.part);
    const vec2 way = fromMiddle + vec2(ray);
    const vec3 m = sight.sceneMetric;
    o.xy = sight.chief + vec2(m.x * way.x + m.y * way.y, m.y * way.x + m.z * way.y);
    o.uv = vec2(ray.z, ray.w);
    o.weight = sight.irradiance;
}
