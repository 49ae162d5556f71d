// lib/classify.glsl for fields in which things move: clusters are of slope and velocity.
//
// Bricks of one cluster need not follow one another: what moves alike may be seen before and behind something
// else. Where that makes two clusters meet, the map does not serve the list.
//
// Needs, declared before the include: what lib/classify.glsl needs; keptCluster(uint), which reads what
// keepCluster stored; listedMotion(uint) and motionLayout. In C++ it is included in a struct that has these.
#include "lib/classify.glsl"
#include "lib/motion.glsl"

/// Through which part of lens and shutter a list looks.
struct ListSight {
    LensSight lens;
    float farTime, timeWidth; // from the middle of the shutter; from first to last
};

KERNEL Cluster clusterOfBrick(IN(Brick) brick, IN(BrickMotion) motion) {
    const float turn = 0.5f * motionLayout.brickPx * max(abs(motion.depthRate.x), abs(motion.depthRate.y));
    const Cluster cluster = {
        brick.slopeMin,    brick.slopeMax,    0.0f, 0.5f * (motion.depthRate.x + motion.depthRate.y),
        motion.low - turn, motion.high + turn};
    return cluster;
}

/// Whether two clusters are too near to tell their layers apart.
KERNEL bool meet(IN(Cluster) a, IN(Cluster) b) {
    const float gap = mapLayout.surfaceGap;
    const vec2 behind = a.velocityLow - b.velocityHigh, before = b.velocityLow - a.velocityHigh;
    return a.slopeMin - b.slopeMax <= gap && b.slopeMin - a.slopeMax <= gap &&
           max(max(behind.x, behind.y), max(before.x, before.y)) <= kVelocityGap * gap;
}

KERNEL Cluster joined(IN(Cluster) a, IN(Cluster) b) {
    const Cluster both = {
        min(a.slopeMin, b.slopeMin),       max(a.slopeMax, b.slopeMax),        a.level, a.depthRate,
        min(a.velocityLow, b.velocityLow), max(a.velocityHigh, b.velocityHigh)};
    return both;
}

/// The least and the greatest distance from 0 of a box of velocities, along x or y.
KERNEL vec2 speedRange(IN(Cluster) cluster) {
    const vec2 least = max(max(cluster.velocityLow, -cluster.velocityHigh), vec2(0.0f));
    const vec2 most = max(-cluster.velocityLow, cluster.velocityHigh);
    return vec2(max(least.x, least.y), max(most.x, most.y));
}

/// Judges a cluster when all bricks are in it, and sets its level.
KERNEL void judge(INOUT(Clusters) found, INOUT(Cluster) cluster, IN(ListSight) sight) {
    const float least = sight.lens.blur * max(cluster.slopeMin, -cluster.slopeMax); // to either side
    const float most = max(-cluster.slopeMin, cluster.slopeMax);
    const vec2 speed = speedRange(cluster), range = cluster.velocityHigh - cluster.velocityLow;
    found.inFocus = found.inFocus || least < kMinSlope;
    found.sparse = found.sparse && most * sight.lens.width + speed.y * sight.timeWidth <= kSparsePx;
    found.fits =
        found.fits && most * sight.lens.reach + speed.y * sight.farTime <= mapLayout.reachPx &&
        (cluster.slopeMax - cluster.slopeMin) * sight.lens.radius + max(range.x, range.y) * sight.farTime <=
            kWidestClusterPx;
    cluster.level = levelFor(blurSpread(least, speed.x));
}

/// Puts a brick into the first cluster that it meets, or into a new one.
KERNEL void addBrick(INOUT(Clusters) found, IN(Cluster) brick) {
    for (uint i = 0u; i < found.count; ++i) {
        const Cluster cluster = keptCluster(i);
        if (!meet(cluster, brick)) continue;
        keepCluster(i, joined(cluster, brick));
        return;
    }
    if (found.count < kMaxClusters)
        keepCluster(found.count++, brick);
    else
        found.fits = false;
}

KERNEL uint movingClassOf(uint begin, uint end, IN(LensSight) lens, vec2 times) {
    const ListSight sight = {lens, max(abs(times.x), abs(times.y)), times.y - times.x};
    Clusters found = {0u, true, false, true, 0.0f, 0.0f};
    float finest = 1.0f; // own radius, over R
    const uint last = min(end, begin + uint(kMaxLoopIterations / kMaxClusters));
    for (uint entry = begin; entry < last; ++entry) {
        IN(Brick) brick = listedBrick(entry);
        finest = min(finest, widestRadius(brick));
        addBrick(found, clusterOfBrick(brick, listedMotion(entry)));
    }
    for (uint i = 0u; i < found.count; ++i) {
        Cluster cluster = keptCluster(i);
        for (uint k = i + 1u; k < found.count; ++k) found.fits = found.fits && !meet(cluster, keptCluster(k));
        judge(found, cluster, sight);
        keepCluster(i, cluster);
    }
    return listClassOf(found, finest, last == end);
}
