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
    /// What it refers to must outlive it.
    MapPasses(Device& device, const OutputPattern& pattern, const LensMap& lens,
              const LensDistortion& distortion, const DeviceBins& bins);

    /// Makes a map. `resolve` computes, on the CPU, a texel of level 0 that has more samples than a shader
    /// may loop over. Runs on `commands`, which must be empty, and leaves it empty.
    void makeMap(CommandList& commands, const DeviceBins& bins, const MapLayout& layout,
                 const std::function<MapTexel(ivec2)>& resolve);

    /// Records: writes to `dense` the outputs of a chunk's lists that the map can serve, to `classes` the
    /// class of each list (kInFocusBit), and to `missed` the pixels that the map does not serve, 64 bits per
    /// list. All must live until the commands have run.
    void record(CommandList& commands, const ListPasses& listPasses, const DeviceLists& lists,
                const Buffer& pattern, const OutputPush& push, const Buffer& classes, const Buffer& missed,
                const Buffer& dense);

    const Buffer& texels() const { return texels_; }
    const Buffer& motions() const { return motions_; }

private:
    Device& device_;
    const LensMap& lens_;
    const LensDistortion& distortion_;
    MapLayout layout_{};
    Pass map_, reduce_, classify_, lookup_;
    Buffer texels_, motions_, motionTexels_, lensPoints_, aperture_, clusters_;
    Buffer lensMap_, pinholeMap_, distortionTexels_;
    Buffer sights_; ///< of all groups; through a compound lens, of the lists of a chunk
    bool moves_;
};

} // namespace slant
