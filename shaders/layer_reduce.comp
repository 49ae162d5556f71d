#version 460
// A level of the layer map from the one below: of four texels, the layers of like slope as one. As reduceLevel of
// host/reconstruct/layer_map.cpp.
#extension GL_GOOGLE_include_directive : require
#include "lib/candidate.glsl"
#include "shared/layers.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32f) uniform imageBuffer heads;
layout(set = 0, binding = 1, rgba32f) uniform imageBuffer layers;
layout(push_constant) uniform Push { ReducePush push; };

struct Children {
    vec4 heads[4];
    int texels[4];
};

float nearer(float least, float slope, float bound) { return slope > bound ? min(least, slope) : least; }

float leastAbove(Children children, float slope) {
    float least = kNoLayer;
    for (int i = 0; i < 4; ++i) {
        const vec4 head = children.heads[i];
        least = nearer(nearer(nearer(least, head.x, slope), head.y, slope), head.z, slope);
    }
    return least;
}

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

void main() {
    const ivec2 place = ivec2(gl_GlobalInvocationID.xy), below = push.size, size = below / 2;
    if (place.x >= size.x || place.y >= size.y) return;
    Children children;
    for (int i = 0; i < 4; ++i) {
        const ivec2 child = 2 * place + ivec2(i & 1, i >> 1);
        children.texels[i] = int(push.source) + child.y * below.x + child.x;
        children.heads[i] = imageLoad(heads, children.texels[i]);
    }

    const int texel = int(push.target) + place.y * size.x + place.x;
    vec4 head = vec4(kNoLayer, kNoLayer, kNoLayer, 0.0);
    float begin = 0.0, end = -kInfinity;
    int count = 0;
    for (; count < kMapLayers && nextLayer(children, push.surfaceGap, begin, end); ++count) {
        vec3 sum = vec3(0.0);
        float coverage = 0.0, slopeSum = 0.0;
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < kMapLayers; ++k) {
                const float slope = children.heads[i][k];
                if (!(slope >= begin && slope <= end)) continue;
                const vec4 layer = imageLoad(layers, children.texels[i] * kMapLayers + k);
                sum += layer.w * layer.rgb;
                coverage += layer.w;
                slopeSum += layer.w * slope;
            }
        head[count] = slopeSum / coverage;
        imageStore(layers, texel * kMapLayers + count, vec4(sum / coverage, min(0.25 * coverage, 1.0)));
    }
    head.w = float(count);
    for (int i = count; i < kMapLayers; ++i) imageStore(layers, texel * kMapLayers + i, vec4(0.0));
    imageStore(heads, texel, head);
}
