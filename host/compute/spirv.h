// The embedded shaders, and what their SPIR-V says about how to call them.
#pragma once
#include "compute/texel_format.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace slant {

struct ShaderModule {
    std::string_view name; ///< of the file shaders/NAME.comp
    std::span<const std::uint32_t> words;
};

/// Every module that was embedded at build time.
std::span<const ShaderModule> shaderModules();

/// Throws Error(usage) if there is no such shader.
const ShaderModule& shaderModule(std::string_view name);

struct ShaderBinding {
    std::uint32_t binding = 0;
    std::string name;
    bool storage = false;              ///< imageBuffer (read and write), else textureBuffer (read only)
    bool integers = false;             ///< texels are of unsigned integers, else of floats
    std::optional<TexelFormat> format; ///< the layout qualifier of an imageBuffer
};

struct ShaderMember {
    std::string name;
    std::uint32_t offset = 0; ///< bytes
};

struct ShaderInterface {
    std::array<std::uint32_t, 3> localSize{};
    std::vector<ShaderBinding> bindings; ///< all in set 0, by binding number
    std::uint32_t pushBytes = 0;         ///< size of the push constants, 0 without
    std::string pushStruct;              ///< name of the struct that is the block's only member
    std::vector<ShaderMember> pushMembers;
};

/// Reads the interface of a compute module. Throws Error(usage) for what passes do not use: several sets,
/// resources other than texel buffers, push constants that are not one struct.
ShaderInterface reflect(const ShaderModule& module);

/// One SPIR-V instruction: its opcode (spv::Op) and the words after the first.
struct SpirvInstruction {
    std::uint32_t opcode;
    std::span<const std::uint32_t> operands;
};

/// The instructions of a module in order.
std::vector<SpirvInstruction> instructions(const ShaderModule& module);

/// The literal string that begins at operand `first`.
std::string literalString(const SpirvInstruction& instruction, std::size_t first);

} // namespace slant
