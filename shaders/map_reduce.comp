#version 460
// A level of the layer map from the one below.
#extension GL_GOOGLE_include_directive : require
#include "lib/map_reduce.glsl"
#include "resources/moving.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32ui) uniform uimageBuffer texels;
layout(set = 0, binding = 1, rgba32ui) uniform uimageBuffer mapMotions;
layout(set = 0, binding = 2) uniform textureBuffer motionTexels;
layout(push_constant) uniform Push {
    ReducePush push;
};

void main() {
    const ivec2 place = ivec2(gl_GlobalInvocationID.xy), below = push.size, size = below / 2;
    if (place.x >= size.x || place.y >= size.y) return;
    const int target = int(push.target) + place.y * size.x + place.x;
    Children children;
    ChildMotions moving;
    for (int i = 0; i < 4; ++i) {
        const ivec2 child = 2 * place + ivec2(i & 1, i >> 1);
        const int source = int(push.source) + child.y * below.x + child.x;
        setChild(children, i, imageLoad(texels, source), push.code);
        if (kMoving) setMotion(moving, i, imageLoad(mapMotions, source), READ_MOTION_LAYOUT);
    }
    if (!kMoving) {
        imageStore(texels, target, reduced(children, push.surfaceGap, push.code));
        return;
    }
    const MovingLayers layers =
        reducedMoving(children, moving, push.surfaceGap, push.code, READ_MOTION_LAYOUT);
    imageStore(texels, target, layers.words);
    imageStore(mapMotions, target, layers.motions);
}
