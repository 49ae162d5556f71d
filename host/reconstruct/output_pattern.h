// Where the outputs of a pixel lie: a pattern that is stratified in pixel, lens and time together.
//
// The lens is cut into M cells, one per output, so that output m of every pixel lies in the same small part
// of the lens and a tile of pixels can share its search; within the cell, outputs are jittered from pixel to
// pixel.
// The pixel position and the time come from a Sobol' sequence whose first two dimensions gave the lens cell,
// Owen-scrambled for each pixel. All of it is integer arithmetic, and exact.
//
// Where things move, the shutter is cut into M parts, too, and each output has its own. Groups then are small
// in lens and time together: slots of time come one after another, and in each the groups of the lens.
#pragma once
#include "camera/aperture.h"
#include "camera/lens_map.h"
#include "shared/output.h"
#include "shared/reconstruct.h"

#include <bit>
#include <vector>

namespace slant {

/// The part of the traced shutter that outputs see, where things move.
struct PatternShutter {
    bool moves = false;
    float velocityPx = 0; ///< the fastest in the picture, along x or y, pixels per traced shutter
    float open = 0, span = 1;
};

struct OutputPattern {
    /// One per output: Sobol' bits, bit-reversed, of x, y and time (the part of the shutter itself where
    /// things move); lens cell (column | row << 16), with which output of its group has its place in the
    /// group's order (<< 8). The first 2^n outputs of all groups in that order are a Sobol' sequence too, as
    /// stratified as all.
    std::vector<glm::uvec4> entries;
    ivec2 lensCells{1, 1};       ///< columns, rows of the lens grid; powers of two
    float lensScale = 1;         ///< radius of the disc that outputs look through
    Aperture aperture;           ///< what that disc lets through
    int groupBits = 0;           ///< 2^groupBits consecutive entries make a group
    int sparseBits = 0;          ///< 2^sparseBits of them are enough where a group sees one part of the scene
    std::vector<LensBox> groups; ///< lens positions of each group
    std::vector<LensBox> cells;  ///< the same as parts of the square [-1, 1]^2 that concentricDisc maps
    PatternShutter shutter;
    int slotBits = 0;        ///< there are 2^slotBits slots of time
    std::vector<vec2> times; ///< of each group where things move: first and last, from the shutter's middle

    int outputsPerPixel() const { return int(entries.size()); }
    int groupSize() const { return 1 << groupBits; }
    std::size_t slotOf(std::size_t group) const { return (group << slotBits) / groups.size(); }
    /// The middle of each slot, from the shutter's middle; of the shutter where nothing moves.
    std::vector<float> slotTimes() const;
};

inline constexpr int kMaxOutputsPerPixel = 4096;

/// A power of two from 1 to kMaxOutputsPerPixel.
constexpr bool isOutputCount(int outputsPerPixel) {
    return outputsPerPixel >= 1 && outputsPerPixel <= kMaxOutputsPerPixel &&
           std::has_single_bit(unsigned(outputsPerPixel));
}

/// Groups have up to kMaxGroupSize outputs, fewer if `slopePx`, the largest slope to either side, would
/// spread them over the picture. Throws Error(usage) unless isOutputCount(outputsPerPixel).
OutputPattern makeOutputPattern(int outputsPerPixel, float slopePx, float lensScale = 1,
                                Aperture aperture = {}, const PatternShutter& shutter = {});

/// Takes an output from the film to the scene's side of a lens, where samples are searched
/// (camera/lens_map.h).
void toSceneSide(const LensMap& lens, Output& output);

Output outputAt(ivec2 pixel, int output, const OutputPattern& pattern, uint seed);

} // namespace slant
