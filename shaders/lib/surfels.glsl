// The surfels of a texel: its samples of up to two surfaces, each surface as one.
//
// Needs, declared before the include: kReflects; recordAt(uint), the records in the order of their texels;
// sampleAt(uint), the sample of a record; surfaceAt(uint), normal and nearness of a sample, nearness 0 where
// there is nothing to shade; lightAt(uint, int), part of its radiance; weightAt(uint), what it counts for;
// and keepSurfelOf(uint, uint), which stores the surfel of a record. In C++ it is included in a struct that
// has these, after lib/shading.glsl.
#include "lib/shading.glsl"

struct Surfels {
    vec4 geometry[kSurfels]; // sums of normal and nearness
    float count[kSurfels];
    vec4 light[4 * kSurfels]; // sums and counts, by lightIndex
};

/// Two samples of a texel, the first and the one least like it: there are that many.
struct Seeds {
    vec4 first, second;
    int count;
};

KERNEL Seeds seedsOf(uint begin, uint end) {
    Seeds seeds = {vec4(0.0f), vec4(0.0f), 0};
    float farthest = 1.0f;
    for (uint i = begin; i < end; ++i) {
        IN(vec4) surface = surfaceAt(sampleAt(recordAt(i)));
        if (!(surface.w > 0.0f)) continue;
        if (seeds.count == 0) {
            seeds.first = surface;
            seeds.count = 1;
        }
        const float apart = unlikeness(seeds.first, surface);
        if (!(apart > farthest)) continue;
        farthest = apart;
        seeds.second = surface;
        seeds.count = 2;
    }
    return seeds;
}

/// Of the records [begin, end), those of one texel; they are numbered from `firstSurfel` on. None where there
/// are more records than a shader may loop over: their noise is little.
KERNEL Surfels surfelsOf(uint begin, uint end, uint firstSurfel) {
    Surfels found;
    for (int i = 0; i < kSurfels; ++i) {
        found.geometry[i] = vec4(0.0f);
        found.count[i] = 0.0f;
    }
    for (int i = 0; i < 4 * kSurfels; ++i) found.light[i] = vec4(0.0f);
    if (end - begin > uint(kMaxLoopIterations)) return found;
    const Seeds seeds = seedsOf(begin, end);
    if (seeds.count == 0) return found;
    for (uint i = begin; i < end; ++i) {
        const uint record = recordAt(i), sample_ = sampleAt(record);
        IN(vec4) surface = surfaceAt(sample_);
        if (!(surface.w > 0.0f)) continue;
        const float fromFirst = unlikeness(seeds.first, surface);
        const float fromSecond = seeds.count == 2 ? unlikeness(seeds.second, surface) : kInfinity;
        if (min(fromFirst, fromSecond) > 1.0f) continue;
        const int layer = fromFirst <= fromSecond ? 0 : 1;
        found.geometry[layer] += surface;
        found.count[layer] += 1.0f;
        const float weight = weightAt(sample_);
        for (int part = 0; part < (kReflects ? 2 : 1); ++part)
            found.light[lightIndex(layer, part, int(sample_ & 1u), true)] +=
                weight * vec4(lightAt(sample_, part), 1.0f);
        keepSurfelOf(record, firstSurfel + uint(layer));
    }
    return found;
}

/// Mean normal and nearness; 0 where there is no such surfel.
KERNEL vec4 meanGeometry(IN(Surfels) found, int layer) {
    if (!(found.count[layer] > 0.0f)) return vec4(0.0f);
    const vec4 sum = found.geometry[layer];
    const float length_ = sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
    return vec4(vec3(sum) / max(length_, 1e-20f), sum.w / found.count[layer]);
}
