// Stage "shading" on the device: the same words as filterShading (reconstruct/shading_filter.h).
#pragma once
#include "compute/bin_passes.h"
#include "reconstruct/shading_filter.h"

namespace slant {

class ShadingPasses {
public:
    /// The samples must outlive this.
    ShadingPasses(Device& device, const SceneSideSamples& samples);

    /// Runs on `commands`, which must be empty, and leaves it empty.
    void run(CommandList& commands, const DeviceBins& bins, const ShadingBand& band);

private:
    /// Of each sample.
    struct Inputs {
        Buffer surfaces, illumination, reflectance, reflection;
    };
    struct Surfels;

    static Inputs inputsOf(Device& device, const SceneSideSamples& samples, bool reflects);
    void makeSurfels(CommandList& commands, const DeviceBins& bins, const ShadingBand& band,
                     const Surfels& surfels);

    Device& device_;
    const SceneSideSamples& samples_;
    bool reflects_;
    std::array<std::uint32_t, 3> constants_; ///< those of fieldConstants, and kReflects
    Pass texels_, start_, surfels_, slopes_, bands_, gains_, apply_;
    Inputs inputs_;
};

} // namespace slant
