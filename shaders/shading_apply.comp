#version 460
// The radiance of records with filtered light.
#extension GL_GOOGLE_include_directive : require
#include "lib/shading.glsl"
#include "resources/invocation.glsl"
#include "resources/reflections.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform utextureBuffer samples; // of each record
layout(set = 0, binding = 1) uniform utextureBuffer surfelOfRecord;
layout(set = 0, binding = 2) uniform textureBuffer illumination; // of each sample
layout(set = 0, binding = 3) uniform textureBuffer softened;     // illumination with soft shadows
layout(set = 0, binding = 4) uniform textureBuffer reflectance;
layout(set = 0, binding = 5) uniform textureBuffer reflection;
layout(set = 0, binding = 6) uniform textureBuffer means; // of each surfel, part after part
layout(set = 0, binding = 7) uniform textureBuffer changes;
layout(set = 0, binding = 8, rgba32f) uniform imageBuffer values;
layout(push_constant) uniform Push {
    ShadedPush push;
};

void main() {
    const uint record =
        linearInvocation(gl_WorkGroupID, gl_NumWorkGroups, gl_WorkGroupSize, gl_LocalInvocationIndex);
    if (record >= push.count) return;
    const uint surfel = texelFetch(surfelOfRecord, int(record)).x;
    if (!isShaded(surfel, push)) return;
    const int sample_ = int(texelFetch(samples, int(record)).x), parts = kReflects ? 2 : 1;
    const int i = int(surfel) * parts;
    vec3 light = texelFetch(illumination, sample_).rgb;
    vec3 change =
        texelFetch(reflectance, sample_).rgb *
        (filteredLight(texelFetch(softened, sample_).rgb, texelFetch(means, i), texelFetch(changes, i)) -
         light);
    if (kReflects) {
        light = texelFetch(reflection, sample_).rgb;
        change += filteredLight(light, texelFetch(means, i + 1), texelFetch(changes, i + 1)) - light;
    }
    const vec4 value = imageLoad(values, int(record));
    imageStore(values, int(record), vec4(max(value.rgb + change, vec3(0.0)), value.w));
}
