#include "reconstruct/cpu_chunk.h"

#include "base/parallel.h"

#include <algorithm>
#include <bit>

namespace slant {

CpuChunk::CpuChunk(const Bins& bins, const LayerMap* map, const LensMap& lens, const OutputPattern& pattern,
                   const Band& band, std::uint64_t seed, std::size_t firstGroup, std::size_t groupCount)
    : bins_(bins), map_(map), lens_(lens), pattern_(pattern), layout_(layoutOf(band, pattern, seed)),
      firstGroup_(firstGroup), groups_(pattern.groups.data() + firstGroup, groupCount),
      lensPoints_(lensPoints(pattern)), firstOutput_(int(firstGroup) << pattern.groupBits),
      outputCount_(int(groupCount) << pattern.groupBits) {
    dense.region = band.region;
    dense.groupSize = pattern.groupSize();
    dense.samples.resize(band.region.area() * outputCount_);
}

TileLists CpuChunk::makeLists(float marginPx, std::vector<float>& lensTiles) const {
    if (lens_.empty()) return makeTileLists(bins_, layout_, groups_, marginPx);
    lensTiles = lensTileBounds(lens_, pattern_, firstGroup_, groups_.size(), bins_.grid, layout_, marginPx);
    return makeTileLists(bins_, layout_, groups_.size(), [&](const Brick& brick, std::size_t group) {
        return tilesOfCompoundLens(brick, bins_.grid, layout_, lensTiles, group);
    });
}

SearchContext CpuChunk::contextOf(const TileLists& in, std::size_t list) const {
    const uint first = in.start[list], last = in.start[list + 1];
    return {bins_, std::span(in.bricks).subspan(first, last - first)};
}

void CpuChunk::run(Monitor& monitor, ReconstructReport& report) {
    lists = makeLists(2 * bins_.grid.radiusPx, lensBounds);
    const std::size_t tiles = std::size_t(layout_.tileCount.x) * layout_.tileCount.y;
    classes = ListClasses(tiles * groups_.size());
    parallelFor(0, tiles, 1, [&](std::size_t first, std::size_t last) {
        Counts counts;
        std::uint64_t samples = 0;
        for (std::size_t tile = first; tile < last; ++tile) samples += runTile(tile, counts);
        add(counts);
        monitor.advance(samples);
    });
    report.outputs += counts_.outputs;
    report.fromMap += counts_.fromMap;
    report.visibility += counts_.visibility;
    report.widened += counts_.holes.size();
    widen(report);
}

CpuChunk::Slot CpuChunk::slotAt(ivec2 position, int output) const {
    const std::size_t tiles = std::size_t(layout_.tileCount.x) * layout_.tileCount.y;
    const ivec2 tile = position / kTileSize;
    return {output * dense.region.area() + std::size_t(position.y) * layout_.regionSize.x + position.x,
            std::size_t(output >> pattern_.groupBits) * tiles + std::size_t(tile.y) * layout_.tileCount.x +
                tile.x,
            layout_.regionOrigin + position, output};
}

Output CpuChunk::at(const Slot& slot) const {
    Output output = outputAt(slot.pixel, firstOutput_ + slot.output, pattern_, layout_.seed);
    if (!lens_.empty()) toSceneSide(lens_, output);
    return output;
}

int CpuChunk::takenOf(const ListClass& listClass) const {
    return 1 << (listClass.sparse ? pattern_.sparseBits : pattern_.groupBits);
}

int CpuChunk::memberAt(std::size_t group, int rank, const ListClass& listClass) const {
    const int first = int(group) << pattern_.groupBits;
    return first +
           (listClass.sparse ? inOrder(pattern_.entries[std::size_t(firstOutput_ + first + rank)]) : rank);
}

void CpuChunk::store(const Slot& slot, const Output& output, const Reconstructed& result) {
    dense.samples[slot.sample] = result.outcome == Outcome::resolved
                                     ? vec4(output.weight * result.rgb, output.positionCode)
                                     : vec4(0, 0, 0, -1);
}

std::uint64_t CpuChunk::runTile(std::size_t tile, Counts& counts) {
    const ivec2 corner = kTileSize * ivec2(int(tile) % layout_.tileCount.x, int(tile) / layout_.tileCount.x);
    const ivec2 end = glm::min(corner + kTileSize, layout_.regionSize);
    const std::uint64_t inside = tilePixels(end - corner);
    const std::size_t tiles = std::size_t(layout_.tileCount.x) * layout_.tileCount.y;
    for (std::size_t group = 0; group < groups_.size(); ++group) {
        const std::size_t list = group * tiles + tile;
        ListClass listClass;
        std::uint64_t missed = ~0ull;
        if (map_)
            listClass = classOfList(bins_, contextOf(lists, list).bricks, groups_[group], pattern_.lensScale,
                                    map_->layout);
        if (!listClass.clusters.empty()) missed = takeFromMap(group, corner, listClass);
        classes.set(list, listClass, missed);
        const auto taken = std::uint64_t(takenOf(listClass));
        counts.outputs += taken * std::uint64_t(std::popcount(inside));
        counts.fromMap += taken * std::uint64_t(std::popcount(inside & ~missed));
        for (int y = corner.y; y < end.y; ++y)
            for (int x = corner.x; x < end.x; ++x)
                if ((missed >> tileBit({x, y}) & 1) != 0) searchPixel(group, {x, y}, listClass, counts);
    }
    return std::uint64_t(std::popcount(inside)) * std::uint64_t(outputCount_);
}

void CpuChunk::searchPixel(std::size_t group, ivec2 position, const ListClass& listClass, Counts& counts) {
    for (int rank = 0; rank < pattern_.groupSize(); ++rank) {
        const Slot slot = slotAt(position, memberAt(group, rank, listClass));
        if (rank < takenOf(listClass))
            runSlot(slot, counts);
        else
            dense.samples[slot.sample] = vec4(0, 0, 0, kLeftOut);
    }
}

/// The pixels of which an output meets nothing, a bit each. Which they are must not depend on bands, so
/// positions outside the region are looked at too.
std::uint64_t CpuChunk::takeFromMap(std::size_t group, ivec2 corner, const ListClass& listClass) {
    std::uint64_t missed = 0;
    for (int y = corner.y; y < corner.y + kTileSize; ++y)
        for (int x = corner.x; x < corner.x + kTileSize; ++x)
            if (!takePixel(group, ivec2(x, y), listClass)) missed |= 1ull << tileBit({x, y});
    return missed != 0 && listClass.clusters.size() > kPartClusters ? ~0ull : missed;
}

bool CpuChunk::takePixel(std::size_t group, ivec2 position, const ListClass& listClass) {
    const bool inRegion = position.x < layout_.regionSize.x && position.y < layout_.regionSize.y;
    const int taken = takenOf(listClass);
    vec3 sum(0);
    for (int rank = 0; rank < (listClass.inFocus ? pattern_.groupSize() : taken); ++rank) {
        const int k = memberAt(group, rank, listClass);
        const Slot slot = slotAt(position, k);
        if (rank >= taken) {
            if (inRegion) dense.samples[slot.sample] = vec4(0, 0, 0, kLeftOut);
            continue;
        }
        const Output own = at(slot);
        const vec2 place = listClass.inFocus ? own.xy : vec2(slot.pixel) + 0.5f;
        const std::optional<vec3> rgb =
            lookThrough(*map_, listClass.clusters, place, vec2(lensPoints_[std::size_t(firstOutput_ + k)]));
        if (!rgb) return false;
        sum += *rgb;
        if (listClass.inFocus && inRegion) dense.samples[slot.sample] = vec4(*rgb, own.positionCode);
    }
    if (!listClass.inFocus && inRegion)
        dense.samples[slotAt(position, int(group) * pattern_.groupSize()).sample] =
            vec4(sum / float(taken), kWholePixel);
    return true;
}

void CpuChunk::runSlot(const Slot& slot, Counts& counts) {
    const Output output = at(slot);
    if (!(output.weight > 0)) return store(slot, output, {Outcome::resolved}); // the film is dark
    const SearchContext context = contextOf(lists, slot.list);
    Reconstructed result = reconstructNearest(context, output);
    if (result.outcome == Outcome::needsVisibility) {
        ++counts.visibility;
        result = resolveVisibility(context, output, bins_.grid.radiusPx);
    }
    if (result.outcome == Outcome::hole) counts.holes.push_back(slot);
    store(slot, output, result);
}

void CpuChunk::redo(std::span<const uint> indices, ReconstructReport& report) {
    lists = makeLists(2 * bins_.grid.radiusPx, lensBounds);
    const int width = layout_.regionSize.x;
    for (const uint index : indices) {
        const int plane = int(index / dense.region.area()), pixel = int(index % dense.region.area());
        runSlot(slotAt(ivec2(pixel % width, pixel / width), plane), counts_);
    }
    report.visibility += counts_.visibility;
    report.widened += counts_.holes.size();
    widen(report);
}

void CpuChunk::add(const Counts& counts) {
    const std::lock_guard lock(mutex_);
    counts_.outputs += counts.outputs;
    counts_.fromMap += counts.fromMap;
    counts_.visibility += counts.visibility;
    counts_.holes.insert(counts_.holes.end(), counts.holes.begin(), counts.holes.end());
}

/// Outputs that found nothing within 2 R look further, with lists made for it.
void CpuChunk::widen(ReconstructReport& report) {
    std::vector<Slot> holes = counts_.holes;
    float radius = bins_.grid.radiusPx;
    for (int step = 0; step < kWidenings && !holes.empty(); ++step) {
        radius *= 2;
        std::vector<float> lensTiles;
        const TileLists wide = makeLists(2 * radius, lensTiles);
        std::erase_if(holes, [&](const Slot& slot) {
            const Output output = at(slot);
            const Reconstructed result = resolveVisibility(contextOf(wide, slot.list), output, radius);
            store(slot, output, result);
            return result.outcome == Outcome::resolved;
        });
    }
    report.holes += holes.size();
}

} // namespace slant
