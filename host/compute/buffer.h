// Device memory as a texel buffer: what every pass reads (texelFetch) and writes (imageStore, imageLoad).
//
// A buffer is one allocation of its own. Where memory is unified and cached (lavapipe, integrated GPUs) it
// stays mapped and upload/download are plain copies; elsewhere they go through the device's staging buffer.
// Both must not run while a submitted command list uses the buffer.
#pragma once
#include "compute/device.h"
#include "compute/texel_format.h"

#include <span>
#include <type_traits>

namespace slant {

class Buffer {
public:
    /// Contents are undefined. Throws Error(resources) with the numbers when the size is over a limit of the
    /// device or memory runs out. `texels` may be 0.
    Buffer(Device& device, TexelFormat format, std::uint64_t texels);
    ~Buffer();
    Buffer(Buffer&&) noexcept;
    Buffer& operator=(Buffer&&) noexcept;

    TexelFormat format() const;
    std::uint64_t texels() const;
    std::uint64_t bytes() const { return texels() * texelBytes(format()); }

    /// Copies `values` to the texels from `firstTexel` on, or the reverse. Elements may be of any trivially
    /// copyable type; throws Error(usage) if the span, in bytes, does not lie in the buffer.
    template <typename T>
    void upload(std::span<const T> values, std::uint64_t firstTexel = 0) {
        static_assert(std::is_trivially_copyable_v<T>);
        uploadBytes(std::as_bytes(values), firstTexel);
    }
    template <typename T>
    void download(std::span<T> values, std::uint64_t firstTexel = 0) const {
        static_assert(std::is_trivially_copyable_v<T>);
        downloadBytes(std::as_writable_bytes(values), firstTexel);
    }

    struct Impl;
    Impl& impl() const { return *impl_; }

private:
    void uploadBytes(std::span<const std::byte> values, std::uint64_t firstTexel);
    void downloadBytes(std::span<std::byte> values, std::uint64_t firstTexel) const;

    std::unique_ptr<Impl> impl_;
};

} // namespace slant
