// What is seen at a place through a lens position, from the layer map (host/reconstruct/map_lookup.h).
//
// Needs, declared before the include: mapTexelAt(int), which reads the map, and clusterAt(int), which reads
// clusters; mapLayout; kMoving, whether anything moves, and then mapMotionAt(int) and motionLayout; and
// kCompoundLens, whether the map is distorted, and then what lib/lens_distortion.glsl needs. In C++ it is
// included in a struct that has these, after lib/map_texel.glsl and lib/motion.glsl.
#include "lib/candidate.glsl"
#include "lib/lens_distortion.glsl"
#include "lib/map_texel.glsl"
#include "lib/motion.glsl"

/// Lookups of one cluster in one level of the map.
struct Lookup {
    float low, high; // slopes of the cluster, and half a gap to each side
    ivec2 size;      // of the level
    ivec2 origin;    // its first texel
    int begin;
    float scale; // texels per pixel
    SlopeCode code;
    VelocityBox velocities;
};

/// A ray: where it is seen, through which lens position, and when (from the middle of the shutter).
struct Sight {
    vec2 x, uv;
    float time;
};

/// A layer, in the middle of the shutter.
struct FoundLayer {
    uvec2 words;
    float slope;
    vec3 motion; // velocity, depth rate
};

KERNEL Lookup lookUp(IN(Cluster) cluster) {
    const float gap = 0.5f * mapLayout.surfaceGap;
    const int level = int(cluster.level), base = mapLayout.size.x * mapLayout.size.y;
    const Lookup lookup = {cluster.slopeMin - gap,
                           cluster.slopeMax + gap,
                           mapLayout.size >> level,
                           mapLayout.texelsPerPixel * mapLayout.origin >> level,
                           (base - (base >> 2 * level)) / 3 * 4, // 1 + 1/4 + ... of the levels below
                           float(mapLayout.texelsPerPixel) * powerOfTwo(kFloatBias - uint(level)),
                           mapLayout.code,
                           {cluster.velocityLow, cluster.velocityHigh}};
    return lookup;
}

KERNEL bool fits(IN(Lookup) lookup, float slope) {
    return slope >= lookup.low && slope <= lookup.high;
}
KERNEL bool fits(IN(Lookup) lookup, vec3 motion) {
    return !isApart(lookup.velocities, vec2(motion), 0.5f * kVelocityGap * mapLayout.surfaceGap);
}

/// The foremost layer of a texel, counted from raster position 0, that belongs to the cluster; false without
/// one.
KERNEL bool layerAt(IN(Lookup) lookup, ivec2 place, INOUT(FoundLayer) layer) {
    const ivec2 inMap = place - lookup.origin;
    const bool inside = uint(inMap.x) < uint(lookup.size.x) && uint(inMap.y) < uint(lookup.size.y);
    const int index = inside ? lookup.begin + inMap.y * lookup.size.x + inMap.x : 0;
    IN(uvec4) texel = mapTexelAt(index);
    const float front = unpackSlope(texel.y, lookup.code), back = unpackSlope(texel.w, lookup.code);
    bool isFront = fits(lookup, front), isBack = fits(lookup, back);
    if (kMoving) {
        if (!(inside && (isFront || isBack))) return false;
        IN(uvec4) motions = mapMotionAt(index);
        const vec3 frontMotion = unpackMotion(uvec2(motions), motionLayout),
                   backMotion = unpackMotion(uvec2(motions.z, motions.w), motionLayout);
        isFront = isFront && fits(lookup, frontMotion);
        isBack = isBack && fits(lookup, backMotion);
        if (isFront || isBack) layer.motion = isFront ? frontMotion : backMotion;
    }
    const bool found = inside && (isFront || isBack);
    if (found) {
        layer.words = isFront ? uvec2(texel) : uvec2(texel.z, texel.w);
        layer.slope = isFront ? front : back;
    }
    return found;
}

/// Where a ray meets a layer, in texels.
KERNEL vec2 placeOn(IN(Lookup) lookup, IN(Sight) ray, IN(FoundLayer) layer) {
    vec2 p = pinholeOf(ray.x, ray.uv, layer.slope);
    if (kMoving) {
        const vec2 rate = vec2(layer.motion) - layer.motion.z * (layer.slope - motionLayout.c2) * ray.uv;
        p -= ray.time / (1.0f + ray.time * layer.motion.z) * rate;
    }
    if (kCompoundLens) p = distorted(p);
    return p * lookup.scale;
}

/// A few slopes and velocities of the cluster: its middle, then its ends.
KERNEL FoundLayer startAt(IN(Cluster) cluster, int i) {
    const vec3 slopes =
        vec3(0.5f * (cluster.slopeMin + cluster.slopeMax), cluster.slopeMax, cluster.slopeMin);
    FoundLayer layer = {uvec2(0u), i < 3 ? slopes[i] : slopes[0], vec3(0.0f)};
    if (kMoving) {
        const vec2 low = cluster.velocityLow, high = cluster.velocityHigh;
        const vec2 velocity = i == 0   ? 0.5f * (low + high)
                              : i == 1 ? high
                              : i == 2 ? low
                              : i == 3 ? vec2(low.x, high.y)
                                       : vec2(high.x, low.y);
        layer.motion = vec3(velocity, cluster.depthRate);
    }
    return layer;
}

/// Of these, the last that is needed: within a texel one is enough.
KERNEL int lastStart(IN(Lookup) lookup, IN(Cluster) cluster, IN(Sight) ray) {
    float spread = (cluster.slopeMax - cluster.slopeMin) * max(abs(ray.uv.x), abs(ray.uv.y));
    if (kMoving) {
        const vec2 moving = (cluster.velocityHigh - cluster.velocityLow) * abs(ray.time);
        if (max(moving.x, moving.y) * lookup.scale >= 1.0f) return 4;
    }
    return spread * lookup.scale < 1.0f ? 0 : 2;
}

/// Follows a ray, from a few starts, to a place where the map has the slope and motion that led there. The
/// loops test for their end last, since lavapipe executes the rest of an iteration that all invocations have
/// left.
KERNEL FoundLayer settle(IN(Lookup) lookup, IN(Cluster) cluster, IN(Sight) ray) {
    const int last = lastStart(lookup, cluster, ray);
    for (int start = 0;; ++start) {
        FoundLayer layer = startAt(cluster, start);
        ivec2 place = ivec2(floor(placeOn(lookup, ray, layer)));
        bool met = false;
        for (int step_ = 1;; ++step_) {
            const bool found = layerAt(lookup, place, layer);
            met = met || found;
            const ivec2 next = ivec2(floor(placeOn(lookup, ray, layer)));
            if (!found || next == place || step_ == kSettleSteps) break;
            place = next;
        }
        if (met || start == last) return layer;
    }
}

/// The layer around a place, interpolated: radiance times coverage, coverage.
KERNEL vec4 layerAround(IN(Lookup) lookup, vec2 place) {
    const vec2 corner = floor(place - 0.5f), part = place - 0.5f - corner;
    vec4 sum = vec4(0.0f);
    for (int i = 0; i < 4; ++i) {
        const ivec2 step_ = ivec2(i & 1, i >> 1);
        FoundLayer found;
        if (!layerAt(lookup, ivec2(corner) + step_, found)) continue;
        const vec4 layer = unpackLayer(found.words);
        const float weight =
            (step_.x == 1 ? part.x : 1.0f - part.x) * (step_.y == 1 ? part.y : 1.0f - part.y) * layer.w;
        sum += vec4(weight * vec3(layer), weight);
    }
    return sum;
}

/// What a ray sees, added to `sum`; false if no surface is met.
KERNEL bool look(IN(Sight) ray, int clusterBegin, int clusterCount, INOUT(vec3) sum) {
    vec3 rgb = vec3(0.0f), last = vec3(0.0f);
    float transmittance = 1.0f;
    for (int i = 0; i < clusterCount && transmittance >= kOpaque; ++i) {
        IN(Cluster) cluster = clusterAt(clusterBegin + i);
        Lookup lookup = lookUp(cluster);
        // A cluster is as wide as all that its tile sees, and may hold both layers of a texel.
        for (int behind = 0; behind < kMapLayers; ++behind) {
            const FoundLayer met = settle(lookup, cluster, ray);
            const vec4 layer = layerAround(lookup, placeOn(lookup, ray, met));
            if (layer.w > 0.0f) {
                rgb += transmittance * vec3(layer);
                transmittance *= 1.0f - layer.w;
                last = vec3(layer) / layer.w;
            }
            lookup.low = met.slope + mapLayout.surfaceGap;
            if (!(layer.w > 0.0f) || transmittance < kOpaque || lookup.low > cluster.slopeMax) break;
        }
    }
    sum += rgb + transmittance * last;
    return transmittance != 1.0f;
}
