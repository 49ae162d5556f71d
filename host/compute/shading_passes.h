// Stage "shading" on the device: the same words as filterShading (reconstruct/shading_filter.h).
#pragma once
#include "compute/bin_passes.h"
#include "reconstruct/shading_filter.h"

namespace slant {

class ShadingPasses {
public:
    /// Uploads what the filter needs of the samples.
    ShadingPasses(Device& device, const SceneSideSamples& samples, bool reflects);

    /// Runs on `commands`, which must be empty, and leaves it empty.
    void run(CommandList& commands, const DeviceBins& bins, const ShadingBand& band) const;

private:
    /// Of each sample.
    struct Inputs {
        Buffer surfaces, illumination, reflectance, reflection;
    };
    struct Surfels;

    static Inputs inputsOf(Device& device, const SceneSideSamples& samples, bool reflects);
    void makeSurfels(CommandList& commands, const DeviceBins& bins, const ShadingBand& band,
                     const Surfels& surfels) const;

    Device& device_;
    std::uint64_t parts_;                    ///< of light
    std::array<std::uint32_t, 1> constants_; ///< kReflects
    Pass texels_, start_, surfels_, slopes_, bands_, gains_, apply_;
    Inputs inputs_;
};

} // namespace slant
