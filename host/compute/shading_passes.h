// Stage "shading" on the device: the same words as filterShading (reconstruct/shading_filter.h).
#pragma once
#include "compute/bin_passes.h"
#include "reconstruct/shading_filter.h"

namespace slant {

class ShadingPasses {
public:
    /// Uploads what the filter needs of the samples.
    ShadingPasses(Device& device, const SceneSideSamples& samples, const ShadingPlan& plan);

    /// Runs on `commands`, which must be empty, and leaves it empty.
    void run(CommandList& commands, const DeviceBins& bins, const ShadingBand& band) const;

private:
    /// Of each sample.
    struct Inputs {
        Buffer surfaces, illumination, reflectance, reflection;
        Buffer rays, lights, direct, softened; ///< empty without shadow rays
    };
    struct Surfels;
    /// Records in the order of their texels, and the first of each texel.
    struct Texels {
        const Buffer &start, &records;
    };

    static Inputs inputsOf(Device& device, const SceneSideSamples& samples, const ShadingPlan& plan);
    void soften(CommandList& commands, const DeviceBins& bins, const Texels& texels, ivec2 size) const;
    void makeSurfels(CommandList& commands, const DeviceBins& bins, const ShadingBand& band,
                     const Surfels& surfels) const;
    const Buffer& illumination() const { return shadows_ ? inputs_.softened : inputs_.illumination; }

    Device& device_;
    std::uint64_t parts_; ///< of light
    bool shadows_;
    std::array<std::uint32_t, 1> constants_; ///< kReflects
    Pass texels_, start_, rays_, softShadows_, surfels_, slopes_, bands_, gains_, apply_;
    Inputs inputs_;
};

} // namespace slant
