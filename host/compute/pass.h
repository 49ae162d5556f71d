// A compute pipeline made from an embedded shader.
//
// Shaders have one form, which reflection checks: texel buffers at bindings 0, 1, ... of set 0 (textureBuffer
// to read, imageBuffer to write), and push constants that are one struct from shaders/shared.
#pragma once
#include "compute/device.h"
#include "compute/spirv.h"

#include <span>
#include <string_view>

namespace slant {

/// Workgroups of a dispatch.
struct Grid {
    std::uint32_t x = 1, y = 1, z = 1;
};

class Pass {
public:
    /// `constants[i]` is the value of the specialization constant with constant_id i (bits of a uint, int,
    /// bool or float). Throws Error(usage) for an unknown or unfit shader, Error(device) if the driver
    /// refuses it.
    Pass(Device& device, std::string_view shader, std::span<const std::uint32_t> constants = {});
    ~Pass();
    Pass(Pass&&) noexcept;
    Pass& operator=(Pass&&) noexcept;

    std::string_view name() const;
    const ShaderInterface& interface() const;

    /// Enough workgroups for one invocation per item. Beyond the limit of one dimension the grid takes a
    /// second one: the shader finds its item by linearInvocation() (resources/invocation.glsl) and skips
    /// those past the end. Throws Error(resources) if even that is not enough.
    Grid gridFor(std::uint64_t items) const;
    /// Enough workgroups for one invocation per pixel; the shader skips those outside.
    Grid gridOver(std::uint32_t width, std::uint32_t height) const;

    struct Impl;
    const Impl& impl() const { return *impl_; }

private:
    std::unique_ptr<Impl> impl_;
};

} // namespace slant
