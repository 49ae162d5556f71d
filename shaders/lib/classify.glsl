// For a list: the clusters of surfaces that it sees, if its outputs can come from the layer map
// (host/reconstruct/map_lookup.h).
//
// Needs, declared before the include: listedBrick(uint), which reads the lists; keepCluster(uint, Cluster),
// which stores the clusters of the list; and mapLayout. In C++ it is included in a struct that has these,
// after lib/grid.glsl.
#include "lib/grid.glsl"
#include "shared/layer_map.h"

struct Clusters {
    uint count;
    bool fits, inFocus, sparse;
    float slopeMin, slopeMax; // of the one that is open
};

/// Level of the map where lens positions are close enough to one another on a surface of this slope, or blur,
/// or more.
KERNEL float levelFor(float slope) {
    float spacing = float(mapLayout.texelsPerPixel) * mapLayout.spreadPerPx * max(slope, 0.0f);
    int level = 0;
    for (; level + 1 < mapLayout.levels && spacing >= kLevelSpacing; ++level) spacing *= 0.5f;
    return float(level);
}

KERNEL void close(INOUT(Clusters) found, IN(LensSight) sight) {
    const float least = sight.blur * max(found.slopeMin, -found.slopeMax); // to either side
    const float most = max(-found.slopeMin, found.slopeMax), reach = most * sight.reach;
    found.inFocus = found.inFocus || least < kMinSlope;
    found.sparse = found.sparse && most * sight.width <= kSparsePx;
    found.fits = found.fits && reach <= mapLayout.reachPx &&
                 (found.slopeMax - found.slopeMin) * sight.radius <= kWidestClusterPx &&
                 found.count < kMaxClusters;
    keepCluster(found.count, stillCluster(found.slopeMin, found.slopeMax, levelFor(least)));
    ++found.count;
}

/// From all clusters, and the finest own radius over R; `complete`: no brick was left out.
KERNEL uint listClassOf(IN(Clusters) found, float finest, bool complete) {
    const bool tooCoarse = finest * mapLayout.radiusPx * float(mapLayout.texelsPerPixel) < 1.0f;
    const bool served = found.fits && found.count > 0u && complete &&
                        !(found.inFocus && (tooCoarse || found.count > kMaxInFocusClusters));
    uint listClass = served ? found.count : 0u;
    if (served && found.inFocus) listClass |= kInFocusBit;
    if (found.sparse && complete && found.count > 0u) listClass |= kSparseBit;
    return listClass;
}

/// ListClass of the list [begin, end), as in the buffer of classes, see kInFocusBit and kSparseBit.
KERNEL uint classOf(uint begin, uint end, IN(LensSight) sight) {
    Clusters found = {0u, true, false, true, kInfinity, -kInfinity};
    float finest = 1.0f; // own radius, over R
    const uint last = min(end, begin + uint(kMaxLoopIterations));
    for (uint entry = begin; entry < last; ++entry) {
        IN(Brick) brick = listedBrick(entry);
        finest = min(finest, widestRadius(brick));
        if (entry > begin && brick.slopeMin > found.slopeMax + mapLayout.surfaceGap) {
            close(found, sight);
            found.slopeMin = brick.slopeMin;
            found.slopeMax = brick.slopeMax;
        }
        found.slopeMin = min(found.slopeMin, brick.slopeMin);
        found.slopeMax = max(found.slopeMax, brick.slopeMax);
    }
    if (end > begin) close(found, sight);
    return listClassOf(found, finest, last == end);
}
