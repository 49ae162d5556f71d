#version 460
// Planes of dense samples through the pixel filter into the film: one invocation a pixel. As
// host/reconstruct/film_buffer.cpp.
#extension GL_GOOGLE_include_directive : require
#include "shared/reconstruct.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform textureBuffer dense;
layout(set = 0, binding = 1) uniform textureBuffer weights;
layout(set = 0, binding = 2, rgba32f) uniform imageBuffer film;
layout(push_constant) uniform Push { FilterPush push; };

/// Weight of a sample at subpixel q of the pixel `offset` pixels away, along one axis.
float axisWeight(int tableBegin, int tableLength, int offset, int q) {
    const int k = offset * kSubpixels + q - kSubpixels / 2;
    const int index = k >= 0 ? k : -k - 1;
    return index >= tableLength ? 0.0 : texelFetch(weights, tableBegin + index).x;
}

vec4 weighted(vec4 samp, float weight) {
    return vec4(weight * samp.x, weight * samp.y, weight * samp.z, weight);
}

vec4 filtered(vec4 samp, ivec2 offset) {
    if (samp.w < 0.0) return vec4(0.0);
    const int code = int(samp.w);
    return weighted(samp, axisWeight(0, push.tableLength.x, offset.x, code / kSubpixels) *
                              axisWeight(push.tableLength.x, push.tableLength.y, offset.y, code % kSubpixels));
}

/// A sample that stands for a group.
vec4 filteredGroup(vec4 samp, ivec2 offset) {
    const int means = push.tableLength.x + push.tableLength.y;
    const float weight = texelFetch(weights, means + abs(offset.x)).x *
                         texelFetch(weights, means + push.reach.x + 1 + abs(offset.y)).x;
    return weighted(samp, float(push.groupSize) * weight);
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy); // of the band
    if (pixel.x >= push.filmSize.x || pixel.y >= push.rowCount) return;
    const int place = (push.firstRow + pixel.y) * push.filmSize.x + pixel.x;
    const ivec2 reach = push.reach, size = push.regionSize;
    const int end = push.firstPlane + push.planeCount;
    vec4 sum = imageLoad(film, place);
    for (int block = push.firstPlane; block < end; block += kFilmBlock) {
        vec4 part = vec4(0.0);
        for (int group = block; group < min(block + kFilmBlock, end); group += push.groupSize)
            for (int dy = -reach.y; dy <= reach.y; ++dy) {
                const int row = (group * size.y + pixel.y + reach.y + dy) * size.x + pixel.x + reach.x;
                for (int dx = -reach.x; dx <= reach.x; ++dx) {
                    const vec4 first = texelFetch(dense, row + dx);
                    if (first.w == kWholePixel) {
                        part += filteredGroup(first, ivec2(dx, dy));
                        continue;
                    }
                    vec4 taken = filtered(first, ivec2(dx, dy));
                    int leftOut = first.w == kLeftOut ? 1 : 0;
                    for (int k = 1; k < push.groupSize; ++k) {
                        const vec4 samp = texelFetch(dense, row + dx + k * size.x * size.y);
                        taken += filtered(samp, ivec2(dx, dy));
                        if (samp.w == kLeftOut) ++leftOut;
                    }
                    part += float(push.groupSize) / float(push.groupSize - leftOut) * taken;
                }
            }
        sum += part;
    }
    imageStore(film, place, sum);
}
