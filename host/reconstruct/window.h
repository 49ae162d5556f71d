// One output of the method `window`: the samples of a fixed window of pixels around it, after Shu-Hung You,
// "Exploring Light-Field Reconstruction on Realistic Camera" (2014), section 2, the program that Slant grew
// from. Two things differ: weights are normalised (its pictures darkened with more samples), and whether a
// surface surrounds an output is decided by the convex hull of its samples, found in one sweep instead of
// trying all triangles. Samples that blur moves out of the window are not found: the larger the blur, the
// more outputs find nothing at all.
#pragma once
#include "lightfield/scene_side.h"
#include "reconstruct/options.h"
#include "reconstruct/output_pattern.h"
#include "shared/window.h"

#include <vector>

namespace slant {

/// Samples in the order of the field, in the form that the search reads.
struct WindowSamples {
    std::vector<vec4> positions;  ///< pinhole position x, y, slope, square of its radius; far off where the
                                  ///< sample is disabled
    std::vector<vec4> values;     ///< r, g, b, alpha
    std::vector<vec4> motions;    ///< Motion of lib/motion.glsl, where things move; else empty
    std::vector<uint> pixelStart; ///< first sample of each pixel of the bounds, and of one more
};

WindowSamples windowSamples(const SceneSideSamples& samples, ValuePlane plane);

WindowSearch windowSearch(const LightField& field, const WindowOptions& options);

/// The most steps of the loops over a whole window; beyond kMaxWindowSteps the compute path leaves it to the
/// CPU.
std::uint64_t windowSteps(const LightField& field, const WindowSearch& search);

/// kWindowFound and its like.
enum class WindowOutcome { found, parted, filled, hole };

struct WindowResult {
    WindowOutcome outcome = WindowOutcome::hole;
    vec3 rgb{0};
};

/// `scratch` keeps no state between calls; it saves allocations.
WindowResult lookThroughWindow(const WindowSamples& samples, const WindowSearch& search, ivec2 pixel,
                               const Output& output, std::vector<WindowCandidate>& scratch);

} // namespace slant
