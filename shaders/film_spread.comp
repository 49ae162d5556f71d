#version 460
// What the dense samples of a pixel contribute to each pixel around it, through the pixel filter: one
// invocation per pixel. So each sample is read once, and its weights are computed once.
#extension GL_GOOGLE_include_directive : require
#include "shared/reconstruct.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform textureBuffer dense;
layout(set = 0, binding = 1) uniform textureBuffer weights;
layout(set = 0, binding = 2, rgba32f) uniform writeonly imageBuffer spread; // kTaps per pixel, row by row
layout(push_constant) uniform Push {
    FilterPush push;
};
#include "resources/film_taps.glsl"

float filterWeightAt(int i) {
    return texelFetch(weights, i).x;
}
#include "lib/film.glsl"

vec4 sums[kTaps];
float weightX[kColumns], weightY[kRows]; // of a sample
float meanX[kColumns], meanY[kRows];     // of one that stands for all places in its pixel

void setWeights(int code) {
    for (int i = 0; i < kColumns; ++i)
        weightX[i] = axisWeight(0, push.tableLength.x, i - kReachX, code / kSubpixels);
    for (int i = 0; i < kRows; ++i)
        weightY[i] = axisWeight(push.tableLength.x, push.tableLength.y, i - kReachY, code % kSubpixels);
}

void setMeans() {
    const int means = push.tableLength.x + push.tableLength.y;
    for (int i = 0; i < kColumns; ++i) meanX[i] = texelFetch(weights, means + abs(i - kReachX)).x;
    for (int i = 0; i < kRows; ++i) meanY[i] = texelFetch(weights, means + kReachX + 1 + abs(i - kReachY)).x;
}

void addWhole(vec4 samp) {
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column)
            sums[row * kColumns + column] +=
                weighted(samp, float(push.groupSize) * (meanX[column] * meanY[row]));
}

void addOwn(vec4 samp, float scale) {
    setWeights(int(samp.w));
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column)
            sums[row * kColumns + column] += weighted(samp, scale * (weightX[column] * weightY[row]));
}

void main() {
    const ivec2 place = ivec2(gl_GlobalInvocationID.xy); // of the rows that count
    if (place.x >= push.regionSize.x || place.y >= push.rowCount + 2 * kReachY) return;
    const int plane = push.regionSize.x * push.regionSize.y;
    const int inPlane = (push.regionRow + place.y) * push.regionSize.x + place.x;
    setMeans();
    for (int tap = 0; tap < kTaps; ++tap) sums[tap] = vec4(0.0);
    for (int group = push.firstPlane; group < push.firstPlane + push.planeCount; group += push.groupSize) {
        const vec4 first = texelFetch(dense, group * plane + inPlane);
        if (first.w == kWholePixel) {
            addWhole(first);
            continue;
        }
        int leftOut = 0;
        for (int k = 0; k < push.groupSize; ++k)
            if (texelFetch(dense, (group + k) * plane + inPlane).w == kLeftOut) ++leftOut;
        const float scale = float(push.groupSize) / float(push.groupSize - leftOut);
        for (int k = 0; k < push.groupSize; ++k) {
            const vec4 samp = texelFetch(dense, (group + k) * plane + inPlane);
            if (samp.w >= 0.0) addOwn(samp, scale);
        }
    }
    const int begin = (place.y * push.regionSize.x + place.x) * kTaps;
    for (int tap = 0; tap < kTaps; ++tap) imageStore(spread, begin + tap, sums[tap]);
}
