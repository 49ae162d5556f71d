// Bindings 0 to 8 of the passes that look outputs up in the bins, and what lib/search.glsl needs of them.
#ifndef SLANT_RESOURCES_BINS_GLSL
#define SLANT_RESOURCES_BINS_GLSL
#include "resources/brick.glsl"
#include "resources/moving.glsl"

layout(set = 0, binding = 0) uniform textureBuffer positions; // p.x, p.y, slope, visibility weight
layout(set = 0, binding = 1) uniform textureBuffer values;    // r, g, b, R over its own radius
layout(set = 0, binding = 2) uniform utextureBuffer cellStart;
layout(set = 0, binding = 3) uniform utextureBuffer listStart;
layout(set = 0, binding = 4) uniform utextureBuffer listCellBases; // of each listed brick
// Copies of the bricks themselves: one fetch each, since most bricks are skipped.
layout(set = 0, binding = 5) uniform utextureBuffer listBricks;
layout(set = 0, binding = 6) uniform textureBuffer motions;     // Motion
layout(set = 0, binding = 7) uniform textureBuffer listMotions; // of each listed brick
layout(set = 0, binding = 8) uniform textureBuffer motionTexels;
layout(push_constant) uniform Push {
    OutputPush push;
};

const int kMaxSteps = kMaxLoopIterations;

vec4 positionAt(uint record) {
    return texelFetch(positions, int(record));
}
uint cellStartAt(uint cell) {
    return texelFetch(cellStart, int(cell)).x;
}
Brick listedBrick(uint entry) {
    return brickOf(texelFetch(listBricks, int(entry)));
}
uint listedCellBase(uint entry) {
    return texelFetch(listCellBases, int(entry)).x;
}
vec4 motionAt(uint record) {
    return texelFetch(motions, int(record));
}
BrickMotion listedMotion(uint entry) {
    const int i = int(entry) * kBrickMotionTexels;
    return brickMotionOf(texelFetch(listMotions, i), texelFetch(listMotions, i + 1));
}

MotionLayout motionLayout; // main calls readMotionLayout

void readMotionLayout() {
    if (kMoving) motionLayout = READ_MOTION_LAYOUT;
}
vec4 valueAt(uint record) {
    return texelFetch(values, int(record));
}
#endif
