#include "render/backend.h"

#include "compute/compute_reconstructor.h"
#include "reconstruct/cpu_reconstructor.h"

#include <cstdlib>
#include <limits>

namespace slant {

Backend::Backend(const std::string& which, int threads) {
    if (which == "cpu") {
        reconstructor_ = std::make_unique<CpuReconstructor>();
        return;
    }
    if (threads > 0) setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
    DeviceOptions options;
    options.name = which;
    device_ = std::make_unique<Device>(options);
    name_ = device_->info().name;
    reconstructor_ = std::make_unique<ComputeReconstructor>(*device_);
}

Backend::~Backend() = default;

std::uint64_t Backend::maxDenseSamples() const {
    return device_ ? device_->limits().texelBufferElements : std::numeric_limits<std::uint64_t>::max();
}

} // namespace slant
