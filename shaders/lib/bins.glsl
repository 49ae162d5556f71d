// Bindings 0 to 6 of the passes that look outputs up in the bins, and the accessors that lib/search.glsl needs.
// Not a pure library: it is the resource half that reconstruct.comp and visibility.comp share.
#ifndef SLANT_LIB_BINS_GLSL
#define SLANT_LIB_BINS_GLSL
#include "shared/reconstruct.h"

layout(set = 0, binding = 0) uniform textureBuffer positions;   // p.x, p.y, slope, 0
layout(set = 0, binding = 1) uniform textureBuffer radiances;   // r, g, b, alpha
layout(set = 0, binding = 2) uniform utextureBuffer cellStart;
layout(set = 0, binding = 3) uniform utextureBuffer bricks;
layout(set = 0, binding = 4) uniform utextureBuffer listStart;
layout(set = 0, binding = 5) uniform utextureBuffer listBricks;
layout(set = 0, binding = 6) uniform utextureBuffer pattern;
layout(push_constant) uniform Push { OutputPush push; };

vec4 positionAt(uint record) { return texelFetch(positions, int(record)); }
uint cellStartAt(uint cell) { return texelFetch(cellStart, int(cell)).x; }
uint listedBrick(uint entry) { return texelFetch(listBricks, int(entry)).x; }
vec3 radianceAt(uint record) { return texelFetch(radiances, int(record)).rgb; }
#endif
