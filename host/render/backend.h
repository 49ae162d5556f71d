// What runs the reconstruction: the program's own CPU code, or a Vulkan device.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

namespace slant {

class Device;
class Reconstructor;

class Backend {
public:
    /// `which` is "cpu", "auto" for the best device, or part of a device's name; `threads` (0 = all cores)
    /// limits Mesa's software driver, which takes it from the environment when its first device is made.
    /// Throws Error(device) where there is no such device.
    explicit Backend(const std::string& which, int threads = 0);
    ~Backend();
    Backend(const Backend&) = delete;
    Backend& operator=(const Backend&) = delete;

    const std::string& name() const { return name_; }
    Reconstructor& reconstructor() const { return *reconstructor_; }
    /// Dense samples that a buffer holds: with a memory budget no larger than this, the CPU cuts a picture
    /// into chunks that the device can hold.
    std::uint64_t maxDenseSamples() const;

private:
    std::string name_ = "cpu";
    std::unique_ptr<Device> device_; ///< null on the CPU
    std::unique_ptr<Reconstructor> reconstructor_;
};

} // namespace slant
