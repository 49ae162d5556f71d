// Device memory as a texel buffer: what every pass reads (texelFetch) and writes (imageStore, imageLoad).
//
// A buffer is one allocation of its own. Where memory is unified and cached (lavapipe, integrated GPUs) it
// stays mapped and upload/download are plain copies; elsewhere they go through the device's staging buffer.
// Both must not run while a submitted command list uses the buffer.
#pragma once
#include "compute/device.h"
#include "compute/texel_format.h"

#include <ranges>
#include <span>

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

    /// Copies `values` (a vector, span or array of any trivially copyable type) to the texels from
    /// `firstTexel` on, or these texels into `values`. Throws Error(usage) if the range is not inside the
    /// buffer.
    template <std::ranges::contiguous_range Values>
    void upload(const Values& values, std::uint64_t firstTexel = 0) {
        uploadBytes(std::as_bytes(std::span(std::ranges::data(values), std::ranges::size(values))),
                    firstTexel);
    }
    template <std::ranges::contiguous_range Values>
    void download(Values&& values, std::uint64_t firstTexel = 0) const {
        downloadBytes(std::as_writable_bytes(std::span(std::ranges::data(values), std::ranges::size(values))),
                      firstTexel);
    }

    struct Impl;
    Impl& impl() const { return *impl_; }

private:
    void uploadBytes(std::span<const std::byte> values, std::uint64_t firstTexel);
    void downloadBytes(std::span<std::byte> values, std::uint64_t firstTexel) const;

    std::unique_ptr<Impl> impl_;
};

} // namespace slant
