// The reconstruction on a Vulkan device, stage by stage the same as CpuReconstructor.
#pragma once
#include "compute/device.h"
#include "reconstruct/method.h"

namespace slant {

class ComputeReconstructor final : public Reconstructor {
public:
    /// `device` must outlive it and the fields that it prepares.
    explicit ComputeReconstructor(Device& device) : device_(device) {}

    std::unique_ptr<PreparedField> prepare(const LightField& field,
                                           const ReconstructOptions& options) override;

private:
    Device& device_;
};

} // namespace slant
