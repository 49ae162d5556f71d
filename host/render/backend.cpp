#include "render/backend.h"

#include "compute/compute_reconstructor.h"
#include "reconstruct/cpu_reconstructor.h"

#include <cstdlib>

namespace slant {

Backend::Backend(const std::string& which, int threads) {
    if (which == "cpu") {
        reconstructor = std::make_unique<CpuReconstructor>();
        return;
    }
    if (threads > 0) setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
    DeviceOptions options;
    options.name = which;
    device = std::make_unique<Device>(options);
    name = device->info().name;
    reconstructor = std::make_unique<ComputeReconstructor>(*device);
}

} // namespace slant
