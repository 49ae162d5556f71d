// Stages "layer_map" and "layer-map" on the device: the same words as makeLayerMap and lookThrough
// (reconstruct/layer_map.h, reconstruct/map_lookup.h).
#pragma once
#include "compute/list_passes.h"
#include "reconstruct/map_lookup.h"

#include <functional>
#include <vector>

namespace slant {

class MapPasses {
public:
    MapPasses(Device& device, const OutputPattern& pattern);

    /// Makes a map. `resolve` does, on the CPU, a texel of level 0 that has more samples than a
    /// shader may loop over. Runs on `commands`, which must be empty, and leaves it empty.
    void makeMap(CommandList& commands, const DeviceBins& bins, const MapLayout& layout,
                 const std::function<MapTexel(ivec2)>& resolve);

    /// Records: takes from the map, into `dense`, what it can serve of the lists of a chunk; into `classes`,
    /// of each list, its class (kInFocusBit), and into `missed` the pixels that it does not serve, 64 bits a
    /// list. All must live until the commands ran.
    void record(CommandList& commands, const ListPasses& listPasses, const DeviceLists& lists,
                const Buffer& pattern, const OutputPush& push, const Buffer& classes, const Buffer& missed,
                const Buffer& dense);

    const Buffer& texels() const { return texels_; }

private:
    Device& device_;
    MapLayout layout_{};
    Pass map_, reduce_, classify_, lookup_;
    Buffer texels_, lensPoints_, clusters_;
};

} // namespace slant
