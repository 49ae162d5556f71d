#version 460
// A level of the layer map from the one below.
#extension GL_GOOGLE_include_directive : require
#include "lib/map_reduce.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32ui) uniform uimageBuffer texels;
layout(push_constant) uniform Push {
    ReducePush push;
};

void main() {
    const ivec2 place = ivec2(gl_GlobalInvocationID.xy), below = push.size, size = below / 2;
    if (place.x >= size.x || place.y >= size.y) return;
    Children children;
    for (int i = 0; i < 4; ++i) {
        const ivec2 child = 2 * place + ivec2(i & 1, i >> 1);
        setChild(children, i, imageLoad(texels, int(push.source) + child.y * below.x + child.x), push.code);
    }
    imageStore(texels, int(push.target) + place.y * size.x + place.x,
               reduced(children, push.surfaceGap, push.code));
}
