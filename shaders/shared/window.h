// What the method `window` shares between C++ and GLSL.
#ifndef SLANT_SHARED_WINDOW_H
#define SLANT_SHARED_WINDOW_H
#include "shared/reconstruct.h"

SLANT_SHARED_BEGIN

/// Samples near an output that a shader can sort; outputs with more are left to the CPU.
SLANT_SHARED_CONSTANT int kMaxWindowCandidates = 64;
/// Limits on the samples and rows of a window in a shader. These loops are the same for a whole vector of
/// invocations; with what it takes to sort kMaxWindowCandidates they stay below lavapipe's 65,535 steps.
SLANT_SHARED_CONSTANT int kMaxWindowSteps = 60000;
/// This many samples are one surface whatever their order: the fewest that can surround an output.
SLANT_SHARED_CONSTANT int kMinSurface = 3;
/// The Gaussian ends here, at e^-40: a lone distant sample still has a weight.
SLANT_SHARED_CONSTANT float kMaxExponent = 40.0f;

/// One more counter beside kHoleCount and its like: outputs that took the nearest sample of their window.
SLANT_SHARED_CONSTANT uint kFilledCount = 3u;

/// The outcome of an output.
SLANT_SHARED_CONSTANT uint kWindowFound = 0u;  // by one surface alone
SLANT_SHARED_CONSTANT uint kWindowParted = 1u; // surfaces had to be separated
SLANT_SHARED_CONSTANT uint kWindowFilled = 2u; // nothing within the radius: the nearest sample of the window
SLANT_SHARED_CONSTANT uint kWindowHole = 3u;   // nothing: black

/// A sample of a window, seen from the output's lens position.
struct WindowCandidate {
    vec2 offset; // from the output, pixels
    float distance2, slope;
    uint record;
    vec2 velocity; // pixels per shutter
};

/// How an output is found in its window.
struct WindowSearch {
    ivec2 boundsOrigin; // pixel; samples stand in the order row, column, sample of a pixel
    ivec2 boundsSize;   // pixels
    int rangePx;        // the window is 2 rangePx + 1 pixels wide
    float alpha;        // of the Gaussian, per square pixel
    float lensStep;     // trajectories that cross within it to either side are different surfaces
    uint fill;          // not 0: where nothing counts, the nearest sample of the window stands in
};

/// window: outputs of one chunk.
struct WindowPush {
    WindowSearch search;
    OutputLayout outputs;
    ivec2 lensCells;
    float lensScale; // radius of the disc that outputs look through, in lens radii
    int firstOutput; // of the chunk
    uint count;      // invocations
};

SLANT_SHARED_END

#endif
