// What C++ and GLSL share of the layer map and of the outputs that are taken from it.
#ifndef SLANT_SHARED_LAYER_MAP_H
#define SLANT_SHARED_LAYER_MAP_H
#include "shared/reconstruct.h"

SLANT_SHARED_BEGIN

/// Layers that a texel of the map keeps, front to back.
SLANT_SHARED_CONSTANT int kMapLayers = 2;
/// Maximum number of texels of level 0 along a pixel's side.
SLANT_SHARED_CONSTANT int kMaxTexelsPerPixel = 2;
/// Maps begin and end at multiples of this many pixels, and no texel is wider, so that each map has the same
/// texels as any other at all levels.
SLANT_SHARED_CONSTANT int kMapAlignPx = 16;
/// Slope of a layer that a texel does not have.
SLANT_SHARED_CONSTANT float kNoLayer = 1e30f;
SLANT_SHARED_CONSTANT uint kNoSlopeCode = 65535u; // the same, packed

/// A list is taken from the map if each cluster of surfaces, separated by gaps in slope, moves less than
/// this, in pixels, against itself over the lens, and if it has no more than this many clusters.
SLANT_SHARED_CONSTANT float kWidestClusterPx = 8.0f;
SLANT_SHARED_CONSTANT uint kMaxClusters = 16u;
/// A cluster with a smaller slope is in focus. Where samples are denser than texels, the map would soften it
/// and is not used; otherwise each output is looked up at its own place in the pixel.
SLANT_SHARED_CONSTANT float kMinSlope = 0.5f;
/// Maximum number of clusters of such a list: the rims of many objects in focus are more than two layers can
/// hold.
SLANT_SHARED_CONSTANT uint kMaxInFocusClusters = 4u;
/// ListClass of a list: the number of its clusters, 0 if the map does not serve it, with this bit where one
/// of them is in focus.
SLANT_SHARED_CONSTANT uint kInFocusBit = 256u;
/// Where some outputs of a pixel meet nothing in the map, that pixel of the list is searched for in the
/// bins. If the list has more clusters than this, all its pixels are: then the map lacks more there than
/// what was missed.
SLANT_SHARED_CONSTANT uint kPartClusters = 3u;
/// Bit of the class of any list whose lens positions see everything within kSparsePx of one another: a few of
/// its outputs are enough (OutputPattern::sparseBits).
SLANT_SHARED_CONSTANT uint kSparseBit = 512u;
SLANT_SHARED_CONSTANT float kSparsePx = 1.0f;
/// Steps from a slope of a cluster to where the map has it.
SLANT_SHARED_CONSTANT int kSettleSteps = 3;
/// Surfaces that would show through by less than this are not looked up.
SLANT_SHARED_CONSTANT float kOpaque = 0.00390625f;
/// Lens positions of an output may lie this far apart on a surface, in texels, before a coarser level is
/// used.
SLANT_SHARED_CONSTANT float kLevelSpacing = 3.0f;

/// Packed slopes: steps from the least one; `perStep` steps are 1.
struct SlopeCode {
    float least, step, perStep;
};

/// The texels of the map: level 0 has texelsPerPixel along each side of a pixel; each further level half as
/// many, and is stored after the one before.
struct MapLayout {
    ivec2 origin;       // pixel at the corner of the first texel
    ivec2 size;         // texels of level 0
    int texelsPerPixel; // along a side, 1 or kMaxTexelsPerPixel, see mapTexelsPerPixel
    int levels;
    float surfaceGap; // as GridLayout
    float
        reachPx; // a surface that moves farther over the lens may lie outside the map; of its slope's pixels
    float spreadPerPx; // distance of lens positions on a surface that is blurred over a pixel to each side
    SlopeCode code;
    float radiusPx; // as GridLayout
    float tentPx;   // width of a texel of level 0, which is searched for within twice that
};

/// Through which part of the lens a list looks. One texel.
struct LensSight {
    float reach; // the farthest lens position from the middle
    // Of a surface of slope 1, in pixels of the film:
    float radius; // how far it may lie from its pinhole position
    float width;  // how far it may move from one lens position to another
    float blur;   // by how much all of the lens spreads it at least
};

/// A range of slopes, pixels per lens radius, and the level of the map where it is looked up. Where things
/// move also a range of velocities, pixels per shutter, and the middle of its depth rates.
struct Cluster {
    float slopeMin, slopeMax, level;
    float depthRate;
    vec2 velocityLow, velocityHigh;
};
SLANT_SHARED_CONSTANT int kClusterTexels = 2;

/// Of what keeps still.
SLANT_SHARED_FUNCTION Cluster stillCluster(float slopeMin, float slopeMax, float level) {
    Cluster cluster;
    cluster.slopeMin = slopeMin;
    cluster.slopeMax = slopeMax;
    cluster.level = level;
    cluster.depthRate = 0.0f;
    cluster.velocityLow = cluster.velocityHigh = vec2(0.0f);
    return cluster;
}

/// map_reduce: one level from the one below.
struct ReducePush {
    ivec2 size;  // texels of the level below
    uint source; // its first texel
    uint target; // first texel of this level
    float surfaceGap;
    SlopeCode code;
};

/// list_classify, map_lookup.
struct MapLookupPush {
    OutputLayout outputs;
    MapLayout map;
    uint firstGroup; // lens groups of the chunk
    uint count;      // lists
    int groupBits;   // 2^groupBits outputs of a pixel share a list
    int sparseBits;  // 2^sparseBits of them are made in sparse lists
    ivec2 lensCells; // as OutputPush
    float lensScale;
};

SLANT_SHARED_END

#endif
