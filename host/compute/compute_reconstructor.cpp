#include "compute/compute_reconstructor.h"

#include "compute/vulkan_engine.h"

namespace slant {

std::unique_ptr<Engine> ComputeReconstructor::makeEngine(const SceneSideSamples& samples) {
    return std::make_unique<VulkanEngine>(device_, samples);
}

} // namespace slant
