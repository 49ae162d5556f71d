// What the reconstruction shares between C++ and GLSL: constants and the parameters of its passes.
#ifndef SLANT_SHARED_RECONSTRUCT_H
#define SLANT_SHARED_RECONSTRUCT_H
#include "shared/types.h"

SLANT_SHARED_BEGIN

/// Outputs are reconstructed in square tiles with this many pixels per side; one workgroup is one tile.
SLANT_SHARED_CONSTANT int kTileSize = 8;
/// Dense samples of a pixel that are summed up before they go into the film, so that chunks of any number of
/// whole blocks give the same film.
SLANT_SHARED_CONSTANT int kFilmBlock = 32;
/// Maximum number of outputs of a pixel that share a lens group, and so a list of bricks; whole groups make
/// a block.
SLANT_SHARED_CONSTANT int kMaxGroupSize = 8;
/// The search radius R is this over the square root of the samples per pixel where they are fewest; the own
/// radius of a sample is the same with the samples per pixel around it.
SLANT_SHARED_CONSTANT float kSearchRadius = 1.7f;
/// What the tent weights within R of an output add up to, on average, if a surface is all around: every
/// plane has as many samples per square pixel as the pattern. spp * integral of (1 - d / R) = pi / 3
/// kSearchRadius^2.
SLANT_SHARED_CONSTANT float kFullWeight = 3.0264205f;
/// Shares of that from which a surface that surrounds the output is solid, by its samples within R and
/// within 2 R. Lower ones let small bright things grow, higher ones let them fade: `lights` drifts by +0.6 %
/// at 0.6 and 0.45, by -0.7 % at 0.75 and 0.55, by -3.4 % at 0.85 and 0.7 (2 samples per pixel).
SLANT_SHARED_CONSTANT float kSolidInner = 0.68f;
SLANT_SHARED_CONSTANT float kSolidOuter = 0.5f;
/// Positions of outputs inside their pixel are multiples of 1 / kSubpixels (plus half a step).
SLANT_SHARED_CONSTANT int kSubpixels = 4096;
/// Position code of a dense sample that stands for all outputs of its lens group in its pixel, wherever they
/// lie: those in the planes after it are not read.
SLANT_SHARED_CONSTANT float kWholePixel = 16777216.0f; // kSubpixels^2
/// Position code of a dense sample that was left out: the others of its lens group in its pixel stand for it.
SLANT_SHARED_CONSTANT float kLeftOut = -2.0f;
/// An invocation stops before its loops have taken more steps than this, and the output is counted as
/// overflowed. lavapipe breaks loops in silence after 65,535 steps of a vector of up to 16 invocations, which
/// takes every step that any of them takes.
SLANT_SHARED_CONSTANT int kMaxLoopIterations = 4000;
/// The least part of the lens from which a sample that was seen is taken to be visible.
SLANT_SHARED_CONSTANT float kMinVisible = 0.0625f;
/// Slopes at which bounds of tiles are kept (host/reconstruct/lens_tiles.h).
SLANT_SHARED_CONSTANT int kLensTileSlopes = 9;
/// Of each list: where its outputs lie on the scene's side, and on the pupil.
SLANT_SHARED_CONSTANT int kListBoxTexels = 2;
/// Sort key of a sample that no output can use.
SLANT_SHARED_CONSTANT uint kNotBinned = 0xffffffffu;

/// The sparse grid that holds the input samples by pinhole position and slope. A *brick* is a square of
/// cellsPerBrick x cellsPerBrick cells within one bucket of slopes; only occupied bricks are stored.
struct GridLayout {
    vec2 origin;       // raster position of the corner of brick (0, 0)
    float invCell;     // 1 / (side of a cell in pixels)
    int cellsPerBrick; // along one side
    ivec2 brickCount;  // bricks along x and y; those of the rim reach to infinity
    int bucketCount;   // slope buckets; the first and the last reach to infinity
    float slopeMin;    // where the first bucket would begin, pixels per lens radius
    float invBucket;   // 1 / (width of a slope bucket)
    float surfaceGap;  // samples farther apart in slope are on different surfaces; >= a bucket's width
    float radiusPx;    // R: radius of the largest empty circle of the input pattern, where it is sparsest
    uint sampleCount;  // binned samples
};

/// Farther away than any sample that can be seen.
SLANT_SHARED_CONSTANT float kFarPx = 1e9f;

/// The outputs: outputsPerPixel for each pixel of the region.
struct OutputLayout {
    ivec2 regionOrigin; // pixel
    ivec2 regionSize;   // pixels
    ivec2 tileCount;
    int outputsPerPixel; // a power of two
    uint seed;
};

/// An occupied brick: bounds of its samples. One RGBA32UI texel, the floats as bits. Cells count from the
/// grid's origin.
struct Brick {
    uint firstCell; // column | row << 16
    uint extent;    // columns - 1 | rows - 1 << 6 | its widest own radius, in kRadiusSteps of R, << 12
    float slopeMin, slopeMax;
};
SLANT_SHARED_CONSTANT float kRadiusSteps = 524288.0f; // 2^19

/// Pinhole positions of a brick's samples.
struct BrickBox {
    vec2 low, high;
};

/// Margins of a list narrow with the own radii of a brick's samples, but not below this: the layer map
/// searches that far (twice the width of its smallest texels).
SLANT_SHARED_CONSTANT float kMinMarginPx = 1.0f;

/// Words of a brick while its bounds are gathered, each the least of what its samples have: slope in ordered
/// bits, its complement, column, row, the complements of those, and the bits of R over its own radius.
SLANT_SHARED_CONSTANT uint kBoundWords = 7u;

/// Words of the counters that passes append to.
SLANT_SHARED_CONSTANT uint kVisibilityCount = 0u; // outputs that need visibility
SLANT_SHARED_CONSTANT uint kHoleCount = 1u;       // outputs that found nothing
SLANT_SHARED_CONSTANT uint kOverflowCount = 2u;   // outputs over kMaxLoopIterations
SLANT_SHARED_CONSTANT uint kCounters = 4u;

/// Planes of constant slope, cut into square blocks. Each block counts the rays that end before they reach
/// it.
struct OcclusionLayout {
    ivec2 blockCount;   // along x and y, from the grid's origin
    float invBlock;     // 1 / (side of a block in pixels)
    int planeCount;     // plane k stands for slopes from slopeMin + k * spacing on
    float slopeMin;     // pixels per lens radius
    float spacing;      // of planes
    uint stride;        // one sample in this many is followed
    float raysPerBlock; // of these, if none were stopped, where samples are sparsest
};

/// Samples per pixel around any place: sums of the samples of all pixels above and to the left, (size.x + 1)
/// per row.
struct DensityLayout {
    ivec2 origin; // pixel
    ivec2 size;   // pixels; 0 if all have equally many samples
};
/// Samples are counted over at least this many pixels to each side, and taken for at least this many per
/// pixel.
SLANT_SHARED_CONSTANT float kMinHalfPx = 1.5f;
SLANT_SHARED_CONSTANT float kMinDensity = 0.015625f;
/// Half the side of a square that has the area of the unit disc.
SLANT_SHARED_CONSTANT float kHalfSquareOfDisc = 0.88622693f;
/// For a search whose radius narrows to each sample's own, however small that is.
SLANT_SHARED_CONSTANT float kAnyRadiusRatio = 1e9f;

/// bin_place, bin_occlude, bin_gather, bin_cells.
struct BinPush {
    GridLayout grid;
    OcclusionLayout occlusion;
    DensityLayout density;
    ivec2 regionMin, regionMax; // pixels whose outputs count
    float marginPx;             // widest search
    uint firstSample;           // of the uploaded part
    uint count;                 // items of this dispatch
    uint brickTotal;            // occupied bricks
};

/// bin_refocus.
struct RefocusPush {
    uint recordCount, brickCount;
    float slopeShift; // pixels per lens radius
};

/// bin_values.
struct CountPush {
    uint count;
};

/// list_count, list_emit, reconstruct, visibility.
struct OutputPush {
    GridLayout grid;
    OutputLayout outputs;
    ivec2 lensCells;
    float lensScale; // radius of the disc that outputs look through, in lens radii
    int firstOutput; // of the chunk
    uint count;      // invocations
    uint firstGroup; // lens groups of the chunk
    uint groupCount;
    uint brickTotal;
    float marginPx;     // of lists, around a tile
    float baseRadiusPx; // of surfaces: their inner tent
    int groupBits;      // 2^groupBits outputs of a pixel share a list
    int takenBits;      // 2^takenBits of them are made, the first of the group's order
};

/// film_spread, film_gather: planes of dense samples into rows of the film.
struct FilterPush {
    ivec2 regionSize;  // of the dense planes
    ivec2 tableLength; // entries of each axis
    ivec2 filmSize;
    int firstRow;  // of the film
    int rowCount;  // of the film; with the filter's reach above and below, those of the region that count
    int regionRow; // of the region, the first that counts
    int firstPlane;
    int planeCount;
    int groupSize; // planes of a lens group
};

/// list_start.
struct LowerBoundPush {
    uint keyCount;
    uint count;
};

SLANT_SHARED_END

#endif
