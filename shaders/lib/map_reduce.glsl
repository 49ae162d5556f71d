// A texel of the layer map from the four below it: their layers of similar slope become one.
#ifndef SLANT_LIB_MAP_REDUCE_GLSL
#define SLANT_LIB_MAP_REDUCE_GLSL
#include "lib/map_texel.glsl"

SLANT_SHARED_BEGIN

/// The layers of the four texels below one.
struct Children {
    uvec2 words[4 * kMapLayers];
    float slopes[4 * kMapLayers]; // kNoLayer without one
};

/// `i` counts the texels below.
KERNEL void setChild(INOUT(Children) children, int i, uvec4 texel, IN(SlopeCode) code) {
    children.words[2 * i] = uvec2(texel);
    children.words[2 * i + 1] = uvec2(texel.z, texel.w);
    children.slopes[2 * i] = unpackSlope(texel.y, code);
    children.slopes[2 * i + 1] = unpackSlope(texel.w, code);
}

KERNEL float leastAbove(IN(Children) children, float slope) {
    float least = kNoLayer;
    for (int i = 0; i < 4 * kMapLayers; ++i)
        if (children.slopes[i] > slope) least = min(least, children.slopes[i]);
    return least;
}

/// The layers of all children within [begin, end] as one; false when there are none left.
KERNEL bool nextLayer(IN(Children) children, float gap, INOUT(float) begin, INOUT(float) end) {
    begin = leastAbove(children, end);
    end = begin;
    if (begin >= kNoLayer) return false;
    for (int i = 0; i < 4 * kMapLayers; ++i) {
        const float next = leastAbove(children, end);
        if (next > end + gap) break;
        end = next;
    }
    return true;
}

KERNEL uvec2 merged(IN(Children) children, float begin, float end, IN(SlopeCode) code) {
    vec3 sum = vec3(0.0f);
    float coverage = 0.0f, slopeSum = 0.0f;
    for (int i = 0; i < 4 * kMapLayers; ++i) {
        if (!(children.slopes[i] >= begin && children.slopes[i] <= end)) continue;
        const vec4 layer = unpackLayer(children.words[i]);
        sum += layer.w * vec3(layer);
        coverage += layer.w;
        slopeSum += layer.w * children.slopes[i];
    }
    return packLayer(sum / coverage, min(0.25f * coverage, 1.0f), slopeSum / coverage, code);
}

KERNEL uvec4 reduced(IN(Children) children, float surfaceGap, IN(SlopeCode) code) {
    uvec2 words[kMapLayers] = {kNoLayerWords, kNoLayerWords};
    float begin = 0.0f, end = -kInfinity;
    for (int count = 0; count < kMapLayers && nextLayer(children, surfaceGap, begin, end); ++count)
        words[count] = merged(children, begin, end, code);
    return uvec4(words[0], words[1]);
}

SLANT_SHARED_END
#endif
