// A texel of the layer map from the four below it: their layers of similar slope become one.
#ifndef SLANT_LIB_MAP_REDUCE_GLSL
#define SLANT_LIB_MAP_REDUCE_GLSL
#include "lib/map_texel.glsl"

SLANT_SHARED_BEGIN

/// The layers of the four texels below one.
struct Children {
    uvec2 words[4 * kMapLayers];
    float slopes[4 * kMapLayers]; // kNoLayer without one
};

/// `i` counts the texels below.
KERNEL void setChild(INOUT(Children) children, int i, uvec4 texel, IN(SlopeCode) code) {
    children.words[2 * i] = uvec2(texel);
    children.words[2 * i + 1] = uvec2(texel.z, texel.w);
    children.slopes[2 * i] = unpackSlope(texel.y, code);
    children.slopes[2 * i + 1] = unpackSlope(texel.w, code);
}

KERNEL float leastAbove(IN(Children) children, float slope) {
    float least = kNoLayer;
    for (int i = 0; i < 4 * kMapLayers; ++i)
        if (children.slopes[i] > slope) least = min(least, children.slopes[i]);
    return least;
}

/// The layers of all children within [begin, end] as one; false when there are none left.
KERNEL bool nextLayer(IN(Children) children, float gap, INOUT(float) begin, INOUT(float) end) {
    begin = leastAbove(children, end);
    end = begin;
    if (begin >= kNoLayer) return false;
    for (int i = 0; i < 4 * kMapLayers; ++i) {
        const float next = leastAbove(children, end);
        if (next > end + gap) break;
        end = next;
    }
    return true;
}

KERNEL uvec2 merged(IN(Children) children, float begin, float end, IN(SlopeCode) code) {
    vec3 sum = vec3(0.0f);
    float coverage = 0.0f, slopeSum = 0.0f;
    for (int i = 0; i < 4 * kMapLayers; ++i) {
        if (!(children.slopes[i] >= begin && children.slopes[i] <= end)) continue;
        const vec4 layer = unpackLayer(children.words[i]);
        sum += layer.w * vec3(layer);
        coverage += layer.w;
        slopeSum += layer.w * children.slopes[i];
    }
    return packLayer(sum / coverage, min(0.25f * coverage, 1.0f), slopeSum / coverage, code);
}

KERNEL uvec4 reduced(IN(Children) children, float surfaceGap, IN(SlopeCode) code) {
    uvec2 words[kMapLayers] = {kNoLayerWords, kNoLayerWords};
    float begin = 0.0f, end = -kInfinity;
    for (int count = 0; count < kMapLayers && nextLayer(children, surfaceGap, begin, end); ++count)
        words[count] = merged(children, begin, end, code);
    return uvec4(words[0], words[1]);
}

/// Where things move: how each layer does.
struct ChildMotions {
    vec3 motions[4 * kMapLayers];
};

KERNEL void setMotion(INOUT(ChildMotions) children, int i, uvec4 texel, IN(MotionLayout) layout_) {
    children.motions[2 * i] = unpackMotion(uvec2(texel), layout_);
    children.motions[2 * i + 1] = unpackMotion(uvec2(texel.z, texel.w), layout_);
}

/// A layer and how it moves.
struct MovingLayers {
    uvec4 words, motions; // of both
};

/// The foremost layer that is left, and all of similar slope that move alike: bits of those. 0 when none is
/// left.
KERNEL uint nextMovingLayer(IN(Children) children, IN(ChildMotions) moving, uint taken, float gap,
                            float velocityGap) {
    int front = -1;
    for (int i = 0; i < 4 * kMapLayers; ++i) {
        const bool left = (taken >> i & 1u) == 0u && children.slopes[i] < kNoLayer;
        if (left && (front < 0 || children.slopes[i] < children.slopes[front])) front = i;
    }
    if (front < 0) return 0u;
    uint found = 0u;
    for (int i = 0; i < 4 * kMapLayers; ++i) {
        const vec2 apart = abs(vec2(moving.motions[i]) - vec2(moving.motions[front]));
        if ((taken >> i & 1u) == 0u && children.slopes[i] <= children.slopes[front] + gap &&
            max(apart.x, apart.y) <= velocityGap)
            found |= 1u << i;
    }
    return found;
}

/// Adds the layers `found` as one.
KERNEL void mergeMoving(IN(Children) children, IN(ChildMotions) moving, uint found, int count,
                        IN(SlopeCode) code, IN(MotionLayout) layout_, INOUT(MovingLayers) texel) {
    vec3 sum = vec3(0.0f), motion = vec3(0.0f);
    float coverage = 0.0f, slopeSum = 0.0f;
    for (int i = 0; i < 4 * kMapLayers; ++i) {
        if ((found >> i & 1u) == 0u) continue;
        const vec4 layer = unpackLayer(children.words[i]);
        sum += layer.w * vec3(layer);
        motion += layer.w * moving.motions[i];
        coverage += layer.w;
        slopeSum += layer.w * children.slopes[i];
    }
    const uvec2 words = packLayer(sum / coverage, min(0.25f * coverage, 1.0f), slopeSum / coverage, code);
    const uvec2 motionWords = packMotion(motion / coverage, layout_);
    texel.words = count == 0 ? uvec4(words, kNoLayerWords) : uvec4(uvec2(texel.words), words);
    texel.motions = count == 0 ? uvec4(motionWords, 0u, 0u) : uvec4(uvec2(texel.motions), motionWords);
}

KERNEL MovingLayers reducedMoving(IN(Children) children, IN(ChildMotions) moving, float surfaceGap,
                                  IN(SlopeCode) code, IN(MotionLayout) layout_) {
    MovingLayers texel = {uvec4(kNoLayerWords, kNoLayerWords), uvec4(0u)};
    uint taken = 0u;
    for (int count = 0; count < kMapLayers; ++count) {
        const uint found = nextMovingLayer(children, moving, taken, surfaceGap, kVelocityGap * surfaceGap);
        if (found == 0u) break;
        mergeMoving(children, moving, found, count, code, layout_, texel);
        taken |= found;
    }
    return texel;
}

SLANT_SHARED_END
#endif
