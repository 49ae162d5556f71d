// What the sources behind compute's public headers share: Vulkan itself, the internals of the device, and the
// conversion of Vulkan failures into Error.
#pragma once
#include "base/error.h"
#include "compute/buffer.h"
#include "compute/device.h"
#include "compute/pass.h"
#include "compute/validation.h"

#include <functional>
#include <optional>
#include <utility>
#include <vulkan/vulkan_raii.hpp>

namespace slant {

/// Runs `action`; a Vulkan failure in it becomes Error(resources) when memory ran out, else Error(device).
/// `doing` says when, e.g. "allocating 64 bytes".
template <typename Action>
decltype(auto) checked(std::string_view doing, Action&& action) {
    try {
        return std::forward<Action>(action)();
    } catch (const vk::OutOfHostMemoryError&) {
        throw Error(ErrorCode::resources, fmt::format("out of host memory while {}", doing));
    } catch (const vk::OutOfDeviceMemoryError&) {
        throw Error(ErrorCode::resources, fmt::format("out of device memory while {}", doing));
    } catch (const vk::DeviceLostError&) {
        throw Error(ErrorCode::device, fmt::format("the device was lost while {}", doing));
    } catch (const vk::SystemError& error) {
        throw Error(ErrorCode::device, fmt::format("Vulkan failed while {}: {}", doing, error.what()));
    }
}

constexpr vk::Format vulkanFormat(TexelFormat format) {
    constexpr vk::Format formats[] = {vk::Format::eR32Uint, vk::Format::eR32G32B32A32Uint,
                                      vk::Format::eR32Sfloat, vk::Format::eR32G32B32A32Sfloat,
                                      vk::Format::eR16G16B16A16Sfloat};
    return formats[int(format)];
}

/// Host-visible memory for writing and reading buffers in device-local memory.
struct StagingBuffer {
    static constexpr std::uint64_t kBytes = 16 << 20;
    vk::raii::DeviceMemory memory;
    vk::raii::Buffer buffer;
    std::byte* mapped;
};

struct Device::Impl {
    explicit Impl(const DeviceOptions& options);

    /// Index of a memory type among `typeBits` with all of `wanted`, if there is one.
    std::optional<std::uint32_t> memoryType(std::uint32_t typeBits, vk::MemoryPropertyFlags wanted) const;
    StagingBuffer& staging();
    /// Records commands, runs them and waits for them.
    void runOnce(std::string_view doing, const std::function<void(const vk::raii::CommandBuffer&)>& record);
    /// Waits for a fence; throws Error(device) when the device is lost.
    void wait(const vk::raii::Fence& fence, std::string_view doing) const;

    // Destroyed in reverse order: members come after what they depend on.
    ValidationLog validation;
    bool validate;
    bool forceStaging;
    vk::raii::Context context;
    vk::raii::Instance instance;
    std::optional<vk::raii::DebugUtilsMessengerEXT> messenger;
    vk::raii::PhysicalDevice physical = nullptr;
    DeviceInfo info;
    std::uint32_t queueFamily = 0;
    std::uint32_t timestampBits = 0;
    vk::PhysicalDeviceMemoryProperties memory;
    vk::raii::Device device = nullptr;
    vk::raii::Queue queue = nullptr;
    std::optional<vk::raii::CommandPool> oncePool;
    std::optional<StagingBuffer> stagingBuffer;
    std::uint64_t allocatedBytes = 0;
    std::uint64_t peakBytes = 0;
};

struct Buffer::Impl {
    Impl(Device::Impl& device, TexelFormat format, std::uint64_t texels);
    ~Impl();

    Device::Impl& device;
    TexelFormat format;
    std::uint64_t texels;
    std::uint64_t allocatedBytes = 0;
    vk::raii::DeviceMemory memory = nullptr;
    vk::raii::Buffer buffer = nullptr;
    vk::raii::BufferView view = nullptr;
    std::byte* mapped = nullptr; ///< null where copies go through staging
};

constexpr vk::DescriptorType descriptorType(const ShaderBinding& binding) {
    return binding.storage ? vk::DescriptorType::eStorageTexelBuffer
                           : vk::DescriptorType::eUniformTexelBuffer;
}

struct Pass::Impl {
    Impl(const Device::Impl& device, const ShaderModule& module, std::span<const std::uint32_t> constants);

    std::string name;
    ShaderInterface interface;
    DeviceLimits limits;
    vk::raii::DescriptorSetLayout setLayout = nullptr;
    vk::raii::PipelineLayout layout = nullptr;
    vk::raii::Pipeline pipeline = nullptr;
};

} // namespace slant
