#include "reconstruct/output_pattern.h"

#include "base/error.h"
#include "reconstruct/kernels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

namespace slant {
namespace {

/// Direction numbers of one Sobol' dimension from its primitive polynomial (degree, inner coefficients) and
/// first numbers m (Joe and Kuo 2008, new-joe-kuo-6); degree 0 is the van der Corput sequence.
std::vector<uint> sobolDirections(int degree, uint coefficients, std::vector<uint> m) {
    std::vector<uint> v(32);
    for (int i = 0; i < 32; ++i) {
        if (degree == 0) {
            v[i] = 1u << (31 - i);
        } else if (i < degree) {
            v[i] = m[i] << (31 - i);
        } else {
            v[i] = v[i - degree] ^ (v[i - degree] >> degree);
            for (int k = 1; k < degree; ++k)
                if ((coefficients >> (degree - 1 - k)) & 1u) v[i] ^= v[i - k];
        }
    }
    return v;
}

uint sobol(const std::vector<uint>& directions, uint index) {
    uint bits = 0;
    for (int i = 0; index != 0; ++i, index >>= 1)
        if (index & 1u) bits ^= directions[i];
    return bits;
}

/// Interleaves the bits of column and row.
uint morton(glm::uvec2 cell) {
    uint code = 0;
    for (int bit = 0; bit < 16; ++bit)
        code |= ((cell.x >> bit) & 1u) << (2 * bit) | ((cell.y >> bit) & 1u) << (2 * bit + 1);
    return code;
}

/// Cells of the lens under the entries [first, last), as one rectangle of [-1, 1]^2.
LensBox cellsOf(const OutputPattern& pattern, std::size_t first, std::size_t last) {
    vec2 low(2), high(-2);
    for (std::size_t i = first; i < last; ++i) {
        const vec2 corner = 2.f * vec2(lensCell(pattern.entries[i])) / vec2(pattern.lensCells) - 1.f;
        low = glm::min(low, corner);
        high = glm::max(high, corner + 2.f / vec2(pattern.lensCells));
    }
    return {low, high};
}

/// Pixels over which what a group sees may spread: sharing pays off up to a brick.
constexpr float kSpreadPx = 16;
/// Where things move the fastest decide, and few are; with 32 or 64 `crossing` and `dolly` are slower.
constexpr float kMovingSpreadPx = 48;

/// Bits of the size of a group, and of the number of slots of time.
struct GroupBits {
    int size = 0, slots = 0;
};

/// A lens group of 2^size of M outputs in one of 2^slots slots is about 2 sqrt(2^(size + slots) / M) lens
/// radii wide; what it sees spreads by that times the slope, and by its part of the motion.
float spreadOf(GroupBits bits, int outputsPerPixel, float slopePx, float motionPx) {
    const float lens = 2 * std::sqrt(float(1 << (bits.size + bits.slots)) / float(outputsPerPixel)) * slopePx;
    return lens + motionPx / float(1 << bits.slots);
}

/// The split between lens and time with the least spread.
GroupBits withSlots(int size, int outputsPerPixel, float slopePx, float motionPx) {
    GroupBits best{size, 0};
    if (motionPx == 0) return best;
    for (int slots = 1; (1 << (size + slots)) <= outputsPerPixel; ++slots)
        if (const GroupBits bits{size, slots}; spreadOf(bits, outputsPerPixel, slopePx, motionPx) <
                                               spreadOf(best, outputsPerPixel, slopePx, motionPx))
            best = bits;
    return best;
}

GroupBits groupBitsFor(int outputsPerPixel, float slopePx, float motionPx) {
    GroupBits bits;
    while ((2 << bits.size) <= std::min(outputsPerPixel, kMaxGroupSize)) {
        const GroupBits wider = withSlots(bits.size + 1, outputsPerPixel, slopePx, motionPx);
        if (bits.size > 0 && !(spreadOf(wider, outputsPerPixel, slopePx, motionPx) <=
                               (motionPx > 0 ? kMovingSpreadPx : kSpreadPx)))
            break;
        bits = wider;
    }
    return bits.size > 0 ? bits : withSlots(0, outputsPerPixel, slopePx, motionPx);
}

/// Outputs per pixel that are enough where all see the same: they integrate over the pixel alone.
constexpr int kSparseOutputBits = 5;

struct SequenceEntry {
    uint index; ///< in the sequence
    glm::uvec4 entry;
};

/// The first 2^bits points of a Sobol' sequence, two dimensions of which give the lens cell.
std::vector<SequenceEntry> lensSequence(int bits) {
    const auto lensX = sobolDirections(0, 0, {}), lensY = sobolDirections(1, 0, {1});
    const auto pixelX = sobolDirections(2, 1, {1, 3}), pixelY = sobolDirections(3, 1, {1, 3, 1});
    const auto time = sobolDirections(3, 2, {1, 1, 1});
    const int columnBits = (bits + 1) / 2, rowBits = bits / 2;
    std::vector<SequenceEntry> sequence;
    for (uint i = 0; i < 1u << bits; ++i) {
        const uint column = columnBits ? sobol(lensX, i) >> (32 - columnBits) : 0;
        const uint row = rowBits ? sobol(lensY, i) >> (32 - rowBits) : 0;
        sequence.push_back({i,
                            {bitfieldReverse(sobol(pixelX, i)), bitfieldReverse(sobol(pixelY, i)),
                             bitfieldReverse(sobol(time, i)), column | row << 16}});
    }
    return sequence;
}

/// Which of 2^bits parts of the shutter a time lies in, whose bits are reversed.
uint timeCell(uint reversed, int bits) {
    return bits > 0 ? bitfieldReverse(reversed) >> (32 - bits) : 0;
}

/// From the first to the last time of a group, from the middle of the traced shutter.
vec2 timesOf(std::span<const SequenceEntry> group, const PatternShutter& shutter, int outputsPerPixel) {
    uint first = ~0u, last = 0;
    for (const SequenceEntry& member : group) {
        first = std::min(first, member.entry.z);
        last = std::max(last, member.entry.z);
    }
    const vec2 part = vec2(float(first), float(last + 1)) / float(outputsPerPixel);
    return shutter.open + shutter.span * part - 0.5f;
}

} // namespace

std::vector<float> OutputPattern::slotTimes() const {
    std::vector<float> middles;
    for (int slot = 0; slot < 1 << slotBits; ++slot)
        middles.push_back(shutter.open + shutter.span * (float(slot) + 0.5f) / float(1 << slotBits) - 0.5f);
    return middles;
}

OutputPattern makeOutputPattern(int outputsPerPixel, float slopePx, float lensScale, Aperture aperture,
                                const PatternShutter& shutter) {
    if (!isOutputCount(outputsPerPixel))
        throw Error(ErrorCode::usage,
                    fmt::format("outputs per pixel must be a power of two from 1 to {}, not {}",
                                kMaxOutputsPerPixel, outputsPerPixel));
    const int bits = std::countr_zero(unsigned(outputsPerPixel));
    OutputPattern pattern;
    pattern.lensScale = lensScale;
    pattern.aperture = std::move(aperture);
    pattern.lensCells = {1 << (bits + 1) / 2, 1 << bits / 2};
    pattern.shutter = shutter;
    const GroupBits groups = groupBitsFor(outputsPerPixel, lensScale * slopePx,
                                          shutter.moves ? shutter.span * shutter.velocityPx : 0);
    pattern.groupBits = groups.size;
    pattern.slotBits = groups.slots;
    pattern.sparseBits = std::clamp(kSparseOutputBits - (bits - pattern.groupBits), 0, pattern.groupBits);

    std::vector<SequenceEntry> sequence = lensSequence(bits);
    if (shutter.moves)
        for (SequenceEntry& member : sequence) member.entry.z = timeCell(member.entry.z, bits);
    const auto slotOf = [&](const SequenceEntry& member) {
        return member.entry.z >> (bits - pattern.slotBits);
    };
    std::sort(sequence.begin(), sequence.end(), [&](const auto& left, const auto& right) {
        if (shutter.moves && slotOf(left) != slotOf(right)) return slotOf(left) < slotOf(right);
        return morton(lensCell(left.entry)) < morton(lensCell(right.entry));
    });
    const auto size = std::size_t(pattern.groupSize());
    for (std::size_t first = 0; first < sequence.size(); first += size) {
        const std::span<SequenceEntry> group = std::span(sequence).subspan(first, size);
        for (std::size_t k = 0; k < size; ++k) {
            const auto rank = std::ranges::count_if(
                group, [&](const SequenceEntry& other) { return other.index < group[k].index; });
            group[std::size_t(rank)].entry.w |= uint(k) << 8;
        }
        for (const SequenceEntry& member : group) pattern.entries.push_back(member.entry);
        pattern.cells.push_back(cellsOf(pattern, first, first + size));
        const LensBox box = pattern.aperture.box(pattern.cells.back().min, pattern.cells.back().max);
        pattern.groups.push_back({pattern.lensScale * box.min, pattern.lensScale * box.max});
        if (shutter.moves) pattern.times.push_back(timesOf(group, shutter, outputsPerPixel));
    }
    return pattern;
}

namespace {

struct PatternKernels {
    const Aperture& aperture;

    vec2 lensPosition(vec2 square) const { return aperture.at(square); }
#include "lib/output_pattern.glsl"
};

} // namespace

Output outputAt(ivec2 pixel, int output, const OutputPattern& pattern, uint seed) {
    const uvec4& entry = pattern.entries[std::size_t(output)];
    PatternKernels kernels{pattern.aperture};
    Output o = kernels.outputAt(pixel, output, entry, pattern.lensCells, pattern.lensScale, seed);
    if (pattern.shutter.moves)
        o.t = timeInShutter(pixel, output, entry.z, pattern.outputsPerPixel(), seed,
                            vec2(pattern.shutter.open, pattern.shutter.span));
    return o;
}

void toSceneSide(const LensMap& lens, Output& output) {
    toSceneSide(output, lens.at(output.xy, output.uv));
}

} // namespace slant
