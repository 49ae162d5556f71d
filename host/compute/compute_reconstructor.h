// The reconstruction on a Vulkan device, stage by stage the same as CpuReconstructor.
#pragma once
#include "compute/device.h"
#include "reconstruct/method.h"

#include <memory>

namespace slant {

class ComputeReconstructor final : public Reconstructor {
public:
    /// `device` must outlive it.
    explicit ComputeReconstructor(Device& device);
    ~ComputeReconstructor() override;

    Image reconstruct(const LightField& field, const ReconstructOptions& options, Monitor& monitor,
                      ReconstructReport& report, StageObserver* observer) override;

private:
    Device& device_;
};

} // namespace slant
