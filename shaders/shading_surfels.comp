#version 460
// The surfels of each texel of pinhole position, and which samples are of them.
#extension GL_GOOGLE_include_directive : require
#include "resources/invocation.glsl"
#include "resources/reflections.glsl"
#include "shared/shading.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer texelStart;  // first record of each, and of one more
layout(set = 0, binding = 1) uniform utextureBuffer records;     // in the order of their texels
layout(set = 0, binding = 2) uniform utextureBuffer samples;     // of each record
layout(set = 0, binding = 3) uniform textureBuffer surfaces;     // of each sample: normal, nearness
layout(set = 0, binding = 4) uniform textureBuffer illumination; // of each sample
layout(set = 0, binding = 5) uniform textureBuffer reflection;
layout(set = 0, binding = 6) uniform textureBuffer reflectance; // of each sample, and its weight
layout(set = 0, binding = 7, r32ui) uniform writeonly uimageBuffer surfelOfRecord;
layout(set = 0, binding = 8, rgba32f) uniform writeonly imageBuffer geometry;
layout(set = 0, binding = 9, rgba32f) uniform writeonly imageBuffer light;  // by lightIndex
layout(set = 0, binding = 10, rgba32f) uniform writeonly imageBuffer means; // of each surfel, part after part
layout(push_constant) uniform Push {
    ShadingPush push;
};

uint recordAt(uint i) {
    return texelFetch(records, int(i)).x;
}
uint sampleAt(uint record) {
    return texelFetch(samples, int(record)).x;
}
vec4 surfaceAt(uint sample_) {
    return texelFetch(surfaces, int(sample_));
}
vec3 lightAt(uint sample_, int part) {
    return part == 0 ? texelFetch(illumination, int(sample_)).rgb : texelFetch(reflection, int(sample_)).rgb;
}
float weightAt(uint sample_) {
    return texelFetch(reflectance, int(sample_)).a;
}
void keepSurfelOf(uint record, uint surfel) {
    imageStore(surfelOfRecord, int(record), uvec4(surfel));
}
#include "lib/surfels.glsl"

void main() {
    const int texel =
        int(linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex));
    if (texel >= push.size.x * push.size.y) return;
    const int first = texel * kSurfels, parts = kReflects ? 2 : 1;
    const Surfels found =
        surfelsOf(texelFetch(texelStart, texel).x, texelFetch(texelStart, texel + 1).x, uint(first));
    for (int layer = 0; layer < kSurfels; ++layer) {
        imageStore(geometry, first + layer, meanGeometry(found, layer));
        for (int part = 0; part < parts; ++part) {
            const int from = lightIndex(layer, part, 0, true);
            const int to = lightIndex(first + layer, part, 0, kReflects);
            imageStore(light, to, found.light[from]);
            imageStore(light, to + 1, found.light[from + 1]);
            imageStore(means, (first + layer) * parts + part,
                       vec4(meanOf(found.light[from] + found.light[from + 1]), 0.0));
        }
    }
}
