// The reconstruction on a Vulkan device.
#pragma once
#include "compute/device.h"
#include "reconstruct/prepared_field.h"

namespace slant {

class ComputeReconstructor final : public Reconstructor {
public:
    /// `device` must outlive it and the fields that it prepares.
    explicit ComputeReconstructor(Device& device) : device_(device) {}

private:
    std::unique_ptr<Engine> makeEngine(const SceneSideSamples& samples) override;

    Device& device_;
};

} // namespace slant
