// An output: its place in its pixel, and the way from film to scene.
#ifndef SLANT_LIB_OUTPUT_GLSL
#define SLANT_LIB_OUTPUT_GLSL
#include "shared/output.h"
#include "lib/hash.glsl"
#include "shared/lens_map.h"
#include "shared/reconstruct.h"

SLANT_SHARED_BEGIN

KERNEL Output outputOnFilm(vec2 xy, vec2 uv, float t, float positionCode) {
    const Output o = {xy, uv, t, positionCode, false, 1.0f, vec3(1.0f, 0.0f, 1.0f), vec2(1.0f)};
    return o;
}

/// Takes an output from the film to the scene's side of a lens, where samples are searched
/// (host/camera/lens_map.h): `ray` is what the map gives for it.
KERNEL void toSceneSide(INOUT(Output) o, IN(SceneRay) ray) {
    o.onSceneSide = true;
    o.xy = ray.xy;
    o.uv = ray.uv;
    o.weight = ray.weight;
    o.filmMetric = ray.filmMetric;
    o.extent = ray.extent;
}

/// From a distance on the scene's side to one on the film.
KERNEL vec2 onFilm(IN(Output) o, vec2 offset) {
    const vec3 m = o.filmMetric;
    return vec2(m.x * offset.x + m.y * offset.y, m.y * offset.x + m.z * offset.y);
}

/// Nested uniform scramble of bit-reversed x (Laine and Karras 2011; constants of Burley 2020, listing 1).
KERNEL uint owenScramble(uint reversed, uint seed) {
    uint x = reversed;
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return bitfieldReverse(x);
}

KERNEL uint seedOf(ivec2 pixel, uint seed) {
    return hash(uint(pixel.x) + hash(uint(pixel.y) + hash(seed)));
}

/// Time of an output in its part of a shutter (open, span) that is cut into one for each output of a pixel.
KERNEL float timeInShutter(ivec2 pixel, int index, uint part, int outputsPerPixel, uint seed, vec2 shutter) {
    const uint jitter = hash(hash(seedOf(pixel, seed) ^ 0x9e3779b9u) + uint(index) * 0x85ebca6bu);
    const float place = (float(jitter >> 8) + 0.5f) * (1.0f / 16777216.0f);
    return shutter.x + shutter.y * ((float(part) + place) / float(outputsPerPixel));
}

/// An output of a pixel, seen through the middle of the lens.
KERNEL Output placed(ivec2 pixel, uvec4 entry, uint pixelSeed) {
    const uint qx = owenScramble(entry.x, hash(pixelSeed ^ 0xa511e9b3u)) >> 20;
    const uint qy = owenScramble(entry.y, hash(pixelSeed ^ 0x63d83595u)) >> 20;
    return outputOnFilm(vec2(pixel) + (vec2(float(qx), float(qy)) + 0.5f) * (1.0f / float(kSubpixels)),
                        vec2(0.0f), 0.0f, float(qx * uint(kSubpixels) + qy));
}

SLANT_SHARED_END
#endif
