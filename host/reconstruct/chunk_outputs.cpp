#include "reconstruct/chunk_outputs.h"

#include "base/parallel.h"

#include <algorithm>
#include <bit>

namespace slant {

ChunkOutputs::ChunkOutputs(const Bins& bins, const BrickOrders& orders, const LensMap& lens,
                           const OutputPattern& pattern, const SearchKernel& kernel, const Chunk& chunk)
    : bins_(bins), orders_(orders), lens_(lens), pattern_(pattern), kernel_(kernel), chunk_(chunk),
      groups_(
          std::span(pattern.groups).subspan(std::size_t(chunk.firstGroup), std::size_t(chunk.groupCount))),
      lensPoints_(lensPoints(pattern)) {
    dense.region = chunk.band.region;
    dense.groupSize = pattern.groupSize();
    dense.samples.resize(chunk.outputs());
}

void ChunkOutputs::makeLists() {
    lists = listsWithin(2 * bins_.grid.radiusPx, lensTiles);
}

TileLists ChunkOutputs::listsWithin(float marginPx, LensTiles& found) const {
    const OutputLayout& layout = chunk_.layout;
    const auto first = std::size_t(chunk_.firstGroup);
    const bool moves = bins_.motion.moves();
    if (lens_.empty() && !moves) return makeTileLists(bins_, layout, groups_, marginPx);
    if (!lens_.empty())
        found = lensTilesOf(lens_, pattern_, first, groups_.size(), bins_.grid, layout, marginPx);
    GroupSight sight;
    sight.tilesOf = [&](uint brick, std::size_t group) {
        if (lens_.empty()) return tilesSeeing(bins_, brick, layout, groups_[group], timesOf(group), marginPx);
        return tilesOfCompoundLens(bins_, brick, layout, found.bounds, group, timesOf(group));
    };
    if (!lens_.empty())
        sight.sees = [&](uint brick, std::size_t group, std::size_t list) {
            return listSees(bins_, brick, found, list, timesOf(group));
        };
    if (moves)
        sight.brickAt = [&](std::size_t group, std::size_t rank) {
            return orders_.at(pattern_.slotOf(first + group), rank);
        };
    return makeTileLists(bins_, layout, groups_.size(), sight);
}

/// Of a group of the chunk.
vec2 ChunkOutputs::timesOf(std::size_t group) const {
    return pattern_.times.empty() ? vec2(0) : pattern_.times[std::size_t(chunk_.firstGroup) + group];
}

LensSight ChunkOutputs::sightOf(std::size_t group, std::size_t list) const {
    return lens_.empty() ? sightThrough(groups_[group], pattern_.lensScale) : lensTiles.sights[list];
}

SearchContext ChunkOutputs::contextOf(const TileLists& in, std::size_t list) const {
    const uint first = in.start[list], last = in.start[list + 1];
    return {bins_, std::span(in.bricks).subspan(first, last - first)};
}

std::uint64_t ChunkOutputs::pixelsInside(ivec2 corner) const {
    return tilePixels(chunk_.layout.regionSize - corner);
}

ChunkOutputs::Slot ChunkOutputs::slotAt(ivec2 position, int output) const {
    const OutputLayout& layout = chunk_.layout;
    const ivec2 tile = position / kTileSize;
    return {output * dense.region.area() + std::size_t(position.y) * layout.regionSize.x + position.x,
            std::size_t(output >> pattern_.groupBits) * tileCount() +
                std::size_t(tile.y) * layout.tileCount.x + tile.x,
            layout.regionOrigin + position, output};
}

Output ChunkOutputs::at(const Slot& slot) const {
    Output output = outputAt(slot.pixel, chunk_.firstOutput + slot.output, pattern_, chunk_.layout.seed);
    if (!lens_.empty()) toSceneSide(lens_, output);
    return output;
}

int ChunkOutputs::takenOf(bool sparse) const {
    return 1 << (sparse ? pattern_.sparseBits : pattern_.groupBits);
}

int ChunkOutputs::memberAt(std::size_t group, int rank, bool sparse) const {
    const int first = int(group) << pattern_.groupBits;
    return first +
           (sparse ? inOrder(pattern_.entries[std::size_t(chunk_.firstOutput + first + rank)]) : rank);
}

void ChunkOutputs::store(const Slot& slot, const Output& output, const Reconstructed& result) {
    dense.samples[slot.sample] = result.outcome == Outcome::resolved
                                     ? vec4(output.weight * result.rgb, output.positionCode)
                                     : vec4(0, 0, 0, -1);
}

ListClasses ChunkOutputs::lookUpMap(const LayerMap& map, Monitor& monitor) {
    const std::size_t tiles = std::size_t(tileCount());
    ListClasses classes(tiles * groups_.size());
    parallelFor(0, tiles, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t tile = first; tile < last; ++tile) {
            const int columns = chunk_.layout.tileCount.x;
            const ivec2 corner = kTileSize * ivec2(int(tile) % columns, int(tile) / columns);
            std::uint64_t served = 0;
            for (std::size_t group = 0; group < groups_.size(); ++group) {
                const std::size_t list = group * tiles + tile;
                const ListClass listClass = classOfList(bins_, contextOf(lists, list).bricks,
                                                        sightOf(group, list), timesOf(group), map.layout);
                const std::uint64_t missed =
                    listClass.clusters.empty() ? ~0ull : takeList(map, group, corner, listClass);
                classes.set(list, listClass.code(), missed);
                served += std::uint64_t(std::popcount(pixelsInside(corner) & ~missed));
            }
            monitor.advance(served << pattern_.groupBits);
        }
    });
    return classes;
}

/// The pixels with an output that meets nothing, one bit each. They must not depend on bands, so positions
/// outside the region are tested too.
std::uint64_t ChunkOutputs::takeList(const LayerMap& map, std::size_t group, ivec2 corner,
                                     const ListClass& listClass) {
    std::uint64_t missed = 0;
    for (int y = corner.y; y < corner.y + kTileSize; ++y)
        for (int x = corner.x; x < corner.x + kTileSize; ++x)
            if (!takePixel(map, group, ivec2(x, y), listClass)) missed |= 1ull << tileBit({x, y});
    return missed != 0 && listClass.clusters.size() > kPartClusters ? ~0ull : missed;
}

bool ChunkOutputs::takePixel(const LayerMap& map, std::size_t group, ivec2 position,
                             const ListClass& listClass) {
    const ivec2 size = chunk_.layout.regionSize;
    const bool inRegion = position.x < size.x && position.y < size.y;
    const int taken = takenOf(listClass.sparse);
    const vec2 middle = vec2(chunk_.layout.regionOrigin + position) + 0.5f;
    vec3 sum(0);
    for (int rank = 0; rank < (listClass.inFocus ? pattern_.groupSize() : taken); ++rank) {
        const int k = memberAt(group, rank, listClass.sparse);
        const Slot slot = slotAt(position, k);
        if (rank >= taken) {
            if (inRegion) dense.samples[slot.sample] = vec4(0, 0, 0, kLeftOut);
            continue;
        }
        Output own = outputAt(slot.pixel, chunk_.firstOutput + k, pattern_, chunk_.layout.seed);
        const float light = lens_.ofStop() ? lens_.at(own.xy, own.uv).weight : 0;
        const vec4 point = lensPoints_[std::size_t(chunk_.firstOutput + k)];
        if (!listClass.inFocus) own.xy = middle;
        own.uv = vec2(point);
        // In focus, motion alone blurs, along a line: outputs at the same times in every pixel would cut
        // it into pieces.
        const float time = listClass.inFocus && pattern_.shutter.moves ? own.t - 0.5f : point.z;
        if (!lens_.empty()) toSceneSide(lens_, own);
        if (lens_.ofStop()) own.weight = light; // of its own place, since even ones miss slices at rims
        vec3 rgb(0);
        if (own.weight != 0) { // else the film is dark
            const std::optional<vec3> seen = lookThrough(map, listClass.clusters, own.xy, own.uv, time);
            if (!seen) return false;
            rgb = own.weight * *seen;
        }
        sum += rgb;
        if (listClass.inFocus && inRegion) dense.samples[slot.sample] = vec4(rgb, own.positionCode);
    }
    if (!listClass.inFocus && inRegion)
        dense.samples[slotAt(position, int(group) * pattern_.groupSize()).sample] =
            vec4(sum / float(taken), kWholePixel);
    return true;
}

SearchCounts ChunkOutputs::search(const ListWork& work, Monitor& monitor) {
    Counts sum;
    std::mutex mutex;
    const auto searchItems = [&](const std::vector<ListItem>& items, bool sparse) {
        parallelFor(0, items.size(), 1, [&](std::size_t first, std::size_t last) {
            Counts counts;
            for (std::size_t i = first; i < last; ++i) {
                const ListItem& item = items[i];
                const std::uint64_t missed = work.missed[item.list];
                for (int k = 0; k < kTileSize * kTileSize; ++k)
                    if ((missed >> k & 1) != 0)
                        searchPixel(item.group,
                                    kTileSize * ivec2(item.tileX, item.tileY) +
                                        ivec2(k % kTileSize, k / kTileSize),
                                    sparse, counts);
                monitor.advance(std::uint64_t(std::popcount(missed)) << pattern_.groupBits);
            }
            const std::lock_guard lock(mutex);
            sum.visibility += counts.visibility;
            sum.holes.insert(sum.holes.end(), counts.holes.begin(), counts.holes.end());
        });
    };
    searchItems(work.whole, false);
    searchItems(work.sparse, true);
    return widen(sum);
}

void ChunkOutputs::searchPixel(std::size_t group, ivec2 position, bool sparse, Counts& counts) {
    for (int rank = 0; rank < pattern_.groupSize(); ++rank) {
        const Slot slot = slotAt(position, memberAt(group, rank, sparse));
        if (rank < takenOf(sparse))
            searchSlot(slot, counts);
        else
            dense.samples[slot.sample] = vec4(0, 0, 0, kLeftOut);
    }
}

void ChunkOutputs::searchSlot(const Slot& slot, Counts& counts) {
    const Output output = at(slot);
    if (!(output.weight > 0)) return store(slot, output, {Outcome::resolved}); // the film is dark
    const SearchContext context = contextOf(lists, slot.list);
    Reconstructed result = kernel_.onCpu(context, output);
    if (result.outcome == Outcome::needsVisibility) {
        ++counts.visibility;
        result = resolveVisibility(context, output, bins_.grid.radiusPx);
    }
    if (result.outcome == Outcome::hole) counts.holes.push_back(slot);
    store(slot, output, result);
}

SearchCounts ChunkOutputs::redo(std::span<const uint> indices) {
    Counts counts;
    const int width = chunk_.layout.regionSize.x;
    for (const uint index : indices) {
        const int plane = int(index / dense.region.area()), pixel = int(index % dense.region.area());
        searchSlot(slotAt(ivec2(pixel % width, pixel / width), plane), counts);
    }
    return widen(counts);
}

/// Outputs that found nothing within 2 R search farther, with lists made for that.
SearchCounts ChunkOutputs::widen(Counts& counts) {
    SearchCounts result;
    result.visibility = counts.visibility;
    result.widened = counts.holes.size();
    float radius = bins_.grid.radiusPx;
    for (int step = 0; step < kWidenings && !counts.holes.empty(); ++step) {
        radius *= 2;
        LensTiles wideTiles;
        const TileLists wide = listsWithin(2 * radius, wideTiles);
        std::erase_if(counts.holes, [&](const Slot& slot) {
            const Output output = at(slot);
            const Reconstructed resolved = resolveVisibility(contextOf(wide, slot.list), output, radius);
            store(slot, output, resolved);
            return resolved.outcome == Outcome::resolved;
        });
    }
    result.holes = counts.holes.size();
    return result;
}

} // namespace slant
