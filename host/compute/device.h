// The Vulkan compute device: which devices there are, which one a run uses, and what it can do.
//
// Only host/compute includes Vulkan, and there only vulkan.h and the .cpp files: these headers do without.
// A Device outlives every Buffer, Pass and CommandList made from it; all of them are for one thread at a
// time. Every failure of the driver becomes an Error: `resources` when memory ran out, else `device`.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace slant {

/// What a device allows, as it reports it.
struct DeviceLimits {
    std::uint64_t storageBufferBytes = 0; ///< longest range of a storage buffer that a shader can see
    std::uint64_t texelBufferElements = 0;
    std::uint64_t allocationBytes = 0; ///< largest single allocation
    std::uint64_t heapBytes = 0;       ///< all memory that is local to the device
    std::uint32_t workgroupsX = 0, workgroupsY = 0, workgroupsZ = 0;
    std::uint32_t workgroupInvocations = 0;
    std::uint32_t pushConstantBytes = 0;
    std::uint32_t sharedMemoryBytes = 0;
    std::uint32_t subgroupSize = 0;
    double timestampNanoseconds = 0; ///< per tick; 0 where the compute queue has no timestamps
};

struct DeviceInfo {
    std::string name;
    std::string type; ///< "discrete", "integrated", "virtual", "cpu" or "other"
    std::string driver;
    std::string apiVersion;
    DeviceLimits limits;
    std::string unsuitable; ///< why the program cannot use it; empty if it can
};

/// Every Vulkan device, in the order of preference: usable ones first, then discrete, integrated, virtual,
/// cpu. Throws Error(device) where there is no Vulkan loader or driver.
std::vector<DeviceInfo> listDevices();

/// Whether the environment asks for validation: SLANT_VALIDATE set to anything but "" or "0".
bool validationFromEnvironment();

struct DeviceOptions {
    std::string_view name = "auto"; ///< "auto" for the best, else part of a device's name, in any case
    /// Khronos validation with synchronization checks: any warning or error is thrown as Error(device) by the
    /// call that drew it.
    bool validate = validationFromEnvironment();
    bool forceStaging = false; ///< never map buffers directly, even where memory is unified (for tests)
};

class Device {
public:
    /// Throws Error(device) with the list of devices when none fits, or validation is not installed.
    explicit Device(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const;
    const DeviceLimits& limits() const { return info().limits; }

    /// Bytes in buffers now, and the most there were since construction or resetPeakBytes().
    std::uint64_t allocatedBytes() const;
    std::uint64_t peakBytes() const;
    void resetPeakBytes();

    /// Throws Error(device) with what validation has found since the last call, if anything.
    void checkValidation();

    struct Impl;
    Impl& impl() const { return *impl_; }

private:
    std::unique_ptr<Impl> impl_;
};

} // namespace slant
