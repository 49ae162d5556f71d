#include "compute/buffer.h"

#include "compute/vulkan.h"

#include <algorithm>
#include <cstring>

namespace slant {
namespace {

constexpr vk::BufferUsageFlags kUsage =
    vk::BufferUsageFlagBits::eUniformTexelBuffer | vk::BufferUsageFlagBits::eStorageTexelBuffer |
    vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst;

void requireWithinLimits(const Device::Impl& device, TexelFormat format, std::uint64_t texels) {
    const DeviceLimits& limits = device.info.limits;
    if (texels > limits.texelBufferElements)
        throw Error(ErrorCode::resources, fmt::format("a buffer of {} elements: device '{}' takes at most {}",
                                                      texels, device.info.name, limits.texelBufferElements));
    const std::uint64_t bytes = texels * texelBytes(format);
    const std::uint64_t most = std::min(limits.allocationBytes, limits.heapBytes);
    if (bytes > most)
        throw Error(ErrorCode::resources, fmt::format("a buffer of {} bytes: device '{}' takes at most {}",
                                                      bytes, device.info.name, most));
}

} // namespace

Buffer::Impl::Impl(Device::Impl& device_, TexelFormat format_, std::uint64_t texels_)
    : device(device_), format(format_), texels(texels_) {
    requireWithinLimits(device, format, texels);
    const std::uint64_t bytes =
        std::max<std::uint64_t>(1, texels) * texelBytes(format); // Vulkan has no empty ones
    checked(fmt::format("allocating {} bytes on '{}'", bytes, device.info.name), [&] {
        using Property = vk::MemoryPropertyFlagBits;
        buffer = vk::raii::Buffer(device.device, vk::BufferCreateInfo({}, bytes, kUsage));
        const auto needs = buffer.getMemoryRequirements();
        // The host reads uncached GPU memory slowly, even where it is visible: staging is better there.
        std::optional<std::uint32_t> type;
        if (!device.forceStaging)
            type =
                device.memoryType(needs.memoryTypeBits, Property::eDeviceLocal | Property::eHostVisible |
                                                            Property::eHostCoherent | Property::eHostCached);
        const bool direct = type.has_value();
        if (!direct) type = device.memoryType(needs.memoryTypeBits, Property::eDeviceLocal);
        memory = vk::raii::DeviceMemory(device.device, vk::MemoryAllocateInfo(needs.size, type.value()));
        buffer.bindMemory(*memory, 0);
        view = vk::raii::BufferView(
            device.device, vk::BufferViewCreateInfo({}, *buffer, vulkanFormat(format), 0, VK_WHOLE_SIZE));
        if (direct) mapped = static_cast<std::byte*>(memory.mapMemory(0, VK_WHOLE_SIZE));
        allocatedBytes = needs.size;
    });
    device.allocatedBytes += allocatedBytes;
    device.peakBytes = std::max(device.peakBytes, device.allocatedBytes);
}

Buffer::Impl::~Impl() {
    device.allocatedBytes -= allocatedBytes;
}

Buffer::Buffer(Device& device, TexelFormat format, std::uint64_t texels)
    : impl_(std::make_unique<Impl>(device.impl(), format, texels)) {
    device.checkValidation();
}

Buffer::~Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;

TexelFormat Buffer::format() const {
    return impl_->format;
}

std::uint64_t Buffer::texels() const {
    return impl_->texels;
}

namespace {

/// The byte where a copy of `size` bytes from `firstTexel` on begins.
std::uint64_t copyOffset(const Buffer& buffer, std::uint64_t firstTexel, std::uint64_t size) {
    const std::uint64_t texel = texelBytes(buffer.format());
    if (firstTexel > buffer.texels() || size > (buffer.texels() - firstTexel) * texel)
        throw Error(ErrorCode::usage,
                    fmt::format("copying {} bytes at texel {} of a buffer of {} texels of {} bytes", size,
                                firstTexel, buffer.texels(), texel));
    return firstTexel * texel;
}

} // namespace

void Buffer::uploadBytes(std::span<const std::byte> values, std::uint64_t firstTexel) {
    std::uint64_t offset = copyOffset(*this, firstTexel, values.size());
    if (values.empty()) return;
    if (impl_->mapped) {
        std::memcpy(impl_->mapped + offset, values.data(), values.size());
        return;
    }
    StagingBuffer& staging = impl_->device.staging();
    while (!values.empty()) {
        const auto piece = values.first(std::min<std::size_t>(values.size(), StagingBuffer::kBytes));
        std::memcpy(staging.mapped, piece.data(), piece.size());
        impl_->device.runOnce("uploading", [&](const vk::raii::CommandBuffer& commands) {
            commands.copyBuffer(*staging.buffer, *impl_->buffer, vk::BufferCopy(0, offset, piece.size()));
        });
        values = values.subspan(piece.size());
        offset += piece.size();
    }
}

void Buffer::downloadBytes(std::span<std::byte> values, std::uint64_t firstTexel) const {
    std::uint64_t offset = copyOffset(*this, firstTexel, values.size());
    if (values.empty()) return;
    if (impl_->mapped) {
        std::memcpy(values.data(), impl_->mapped + offset, values.size());
        return;
    }
    StagingBuffer& staging = impl_->device.staging();
    while (!values.empty()) {
        const auto piece = values.first(std::min<std::size_t>(values.size(), StagingBuffer::kBytes));
        impl_->device.runOnce("downloading", [&](const vk::raii::CommandBuffer& commands) {
            commands.copyBuffer(*impl_->buffer, *staging.buffer, vk::BufferCopy(offset, 0, piece.size()));
            const vk::MemoryBarrier visible(vk::AccessFlagBits::eTransferWrite,
                                            vk::AccessFlagBits::eHostRead);
            commands.pipelineBarrier(vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eHost,
                                     {}, visible, {}, {});
        });
        std::memcpy(piece.data(), staging.mapped, piece.size());
        values = values.subspan(piece.size());
        offset += piece.size();
    }
}

} // namespace slant
