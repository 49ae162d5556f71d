// What the reconstruction shares between C++ and GLSL: constants and the parameters of its passes.
#ifndef SLANT_SHARED_RECONSTRUCT_H
#define SLANT_SHARED_RECONSTRUCT_H
#include "shared/types.h"

SLANT_SHARED_BEGIN

/// Outputs are reconstructed in square tiles of this many pixels a side; one workgroup is one tile.
const int kTileSize = 8;
/// Outputs of a pixel that share a lens group, and so a list of bricks.
const int kOutputsPerGroup = 4;
/// A surface of fewer samples than this is merged into the next one behind it.
const int kMinSurfaceSamples = 4;
/// Positions of outputs inside their pixel are multiples of 1 / kSubpixels (plus half a step).
const int kSubpixels = 4096;
/// An invocation stops before it has looked at more candidates than this, and the output is counted as
/// overflowed: lavapipe breaks loops after 65,535 iterations.
const int kMaxLoopIterations = 60000;
/// A sample that is not binned.
const uint kNoBrick = 0xffffffffu;

/// The sparse grid that holds the input samples by pinhole position and slope. A *brick* is a square of
/// cellsPerBrick x cellsPerBrick cells within one bucket of slopes; only occupied bricks are stored.
struct GridLayout {
    vec2 origin;        // raster position of the corner of brick (0, 0)
    float invCell;      // 1 / (side of a cell in pixels)
    int cellsPerBrick;  // along one side
    ivec2 brickCount;   // bricks along x and y
    int bucketCount;    // slope buckets
    float slopeMin;     // pixels per lens radius
    float invBucket;    // 1 / (width of a slope bucket)
    float surfaceGap;    // samples further apart in slope are on different surfaces; >= a bucket's width
    float radiusPx;     // R: radius of the largest empty circle of the input pattern
    int unused;
};

/// The outputs: outputsPerPixel for each pixel of the region.
struct OutputLayout {
    ivec2 regionOrigin; // pixel
    ivec2 regionSize;   // pixels
    ivec2 tileCount;
    int outputsPerPixel; // a power of two
    uint seed;
};

/// An occupied brick: its place in cells and the slopes that its samples have. One RGBA32F texel, the
/// integers as bits.
struct Brick {
    int firstCellX, firstCellY; // its corner, in cells from the grid's origin
    float slopeMin, slopeMax;
};

SLANT_SHARED_END

#endif
