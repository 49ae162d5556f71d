// What runs the reconstruction: the program's own CPU code, or a Vulkan device.
#pragma once
#include "compute/device.h"
#include "reconstruct/prepared_field.h"

#include <memory>
#include <string>

namespace slant {

/// Owns the device, which outlives the reconstructor.
struct Backend {
    /// `which` is "cpu", "auto" for the best device, or part of a device's name; `threads` (0 = all cores)
    /// limits Mesa's software driver, which takes it from the environment when its first device is made.
    /// Throws what Device throws.
    explicit Backend(const std::string& which, int threads = 0);

    std::string name = "cpu";
    std::unique_ptr<Device> device; ///< null on the CPU
    std::unique_ptr<Reconstructor> reconstructor;
};

} // namespace slant
