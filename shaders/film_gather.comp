#version 460
// Adds to a pixel of the film what film_spread found in the pixels around it. Same as FilmBuffer::partOf in
// host/reconstruct/film_buffer.cpp.
#extension GL_GOOGLE_include_directive : require
#include "shared/reconstruct.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform textureBuffer spread;
layout(set = 0, binding = 1, rgba32f) uniform imageBuffer film;
layout(push_constant) uniform Push {
    FilterPush push;
};
#include "resources/film_taps.glsl"

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= push.filmSize.x || pixel.y >= push.rowCount) return;
    vec4 part = vec4(0.0);
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            const int from = (pixel.y + row) * push.regionSize.x + pixel.x + column;
            part += texelFetch(spread, from * kTaps + row * kColumns + column);
        }
    const int place = (push.firstRow + pixel.y) * push.filmSize.x + pixel.x;
    imageStore(film, place, imageLoad(film, place) + part);
}
