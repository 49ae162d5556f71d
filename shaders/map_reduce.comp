#version 460
// A level of the layer map from the one below: of four texels, the layers of like slope as one. As reduceLevel of
// host/reconstruct/layer_map.cpp.
#extension GL_GOOGLE_include_directive : require
#include "lib/candidate.glsl"
#include "lib/map_texel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32ui) uniform uimageBuffer texels;
layout(push_constant) uniform Push { ReducePush push; };

/// The layers of the four texels below one, those that are there.
struct Children {
    uvec2 words[4 * kMapLayers];
    float slopes[4 * kMapLayers];
};

float leastAbove(Children children, float slope) {
    float least = kNoLayer;
    for (int i = 0; i < 4 * kMapLayers; ++i)
        if (children.slopes[i] > slope) least = min(least, children.slopes[i]);
    return least;
}

/// The layers of all children within [begin, end] as one; false when there are none left.
bool nextLayer(Children children, float gap, inout float begin, inout float end) {
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

uvec2 merged(Children children, float begin, float end) {
    vec3 sum = vec3(0.0);
    float coverage = 0.0, slopeSum = 0.0;
    for (int i = 0; i < 4 * kMapLayers; ++i) {
        if (!(children.slopes[i] >= begin && children.slopes[i] <= end)) continue;
        const vec4 layer = unpackLayer(children.words[i]);
        sum += layer.w * layer.rgb;
        coverage += layer.w;
        slopeSum += layer.w * children.slopes[i];
    }
    return packLayer(sum / coverage, min(0.25 * coverage, 1.0), slopeSum / coverage, push.code);
}

void main() {
    const ivec2 place = ivec2(gl_GlobalInvocationID.xy), below = push.size, size = below / 2;
    if (place.x >= size.x || place.y >= size.y) return;
    Children children;
    for (int i = 0; i < 4; ++i) {
        const ivec2 child = 2 * place + ivec2(i & 1, i >> 1);
        const uvec4 texel = imageLoad(texels, int(push.source) + child.y * below.x + child.x);
        children.words[2 * i] = texel.xy;
        children.words[2 * i + 1] = texel.zw;
        children.slopes[2 * i] = unpackSlope(texel.y, push.code);
        children.slopes[2 * i + 1] = unpackSlope(texel.w, push.code);
    }

    uvec2 words[kMapLayers] = uvec2[](kNoLayerWords, kNoLayerWords);
    float begin = 0.0, end = -kInfinity;
    for (int count = 0; count < kMapLayers && nextLayer(children, push.surfaceGap, begin, end); ++count)
        words[count] = merged(children, begin, end);
    imageStore(texels, int(push.target) + place.y * size.x + place.x, uvec4(words[0], words[1]));
}
