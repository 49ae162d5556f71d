// Stages "layer_map" and "rungs" on the device: the same words as makeLayerMap and throughLayers
// (reconstruct/layer_map.h, reconstruct/layers.h).
#pragma once
#include "compute/list_passes.h"
#include "reconstruct/layers.h"

#include <functional>
#include <vector>

namespace slant {

class LayerPasses {
public:
    LayerPasses(Device& device, const OutputPattern& pattern);

    /// Makes a map. `resolve` does, on the CPU, the texel at a pinhole position
    /// that has more samples than a shader may loop over. Runs on `commands`, which must be empty, and leaves
    /// it empty.
    void makeMap(CommandList& commands, const DeviceBins& bins, const MapLayout& layout,
                 const std::function<MapTexel(vec2)>& resolve);

    /// Records: takes from the map, into `dense`, what it can serve of the lists of a chunk; into `rungs`, of
    /// each list, the clusters that it was taken from the map through; 0: none. All must live until the
    /// commands ran.
    void record(CommandList& commands, const ListPasses& listPasses, const DeviceLists& lists,
                const OutputPush& push, const Buffer& rungs, const Buffer& dense);

    const Buffer& heads() const { return heads_; }
    const Buffer& layers() const { return layers_; }

private:
    Device& device_;
    const OutputPattern& pattern_;
    MapLayout layout_{};
    Pass texels_, reduce_, rungsPass_, outputs_;
    Buffer heads_, layers_, lensPoints_, clusters_;
};

} // namespace slant
