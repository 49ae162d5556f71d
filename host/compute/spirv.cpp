#include "compute/spirv.h"

#include "base/error.h"
#include "shaders_embedded.h"

#include <algorithm>
#include <map>
#include <spirv/unified1/spirv.hpp>

namespace slant {
namespace {

Error unsupported(const ShaderModule& module, std::string_view what) {
    return Error(ErrorCode::usage, fmt::format("shader '{}': {}", module.name, what));
}

/// The parts of a module that determine its interface, by id.
struct ModuleTables {
    explicit ModuleTables(const ShaderModule& module) {
        for (const SpirvInstruction& i : instructions(module)) {
            const auto op = i.operands;
            switch (i.opcode) {
            case spv::OpName:
                names[op[0]] = literalString(i, 1);
                break;
            case spv::OpMemberName:
                memberNames[{op[0], op[1]}] = literalString(i, 2);
                break;
            case spv::OpExecutionMode:
                if (op[1] == spv::ExecutionModeLocalSize) localSize = {op[2], op[3], op[4]};
                break;
            case spv::OpDecorate:
                if (op.size() > 2) decorations[{op[0], op[1]}] = op[2];
                break;
            case spv::OpMemberDecorate:
                if (op[2] == spv::DecorationOffset) offsets[{op[0], op[1]}] = op[3];
                break;
            case spv::OpTypeInt:
            case spv::OpTypeFloat:
            case spv::OpTypeVector:
            case spv::OpTypeImage:
            case spv::OpTypeArray:
            case spv::OpTypeStruct:
            case spv::OpTypePointer:
                types[op[0]] = i;
                break;
            case spv::OpConstant:
                constants[op[1]] = op[2];
                break;
            case spv::OpVariable:
                variables.push_back(i);
                break;
            default:
                break;
            }
        }
    }

    /// Bytes that a type takes in a block: its members' ends, without padding behind the last.
    std::uint32_t sizeOf(std::uint32_t id) const {
        const SpirvInstruction& type = types.at(id);
        const auto op = type.operands;
        switch (type.opcode) {
        case spv::OpTypeVector:
            return op[2] * sizeOf(op[1]);
        case spv::OpTypeArray:
            return constants.at(op[2]) * decorations.at({id, spv::DecorationArrayStride});
        case spv::OpTypeStruct: {
            std::uint32_t end = 0;
            for (std::uint32_t m = 0; m + 1 < op.size(); ++m)
                end = std::max(end, offsets.at({id, m}) + sizeOf(op[m + 1]));
            return end;
        }
        default:
            return op[1] / 8;
        }
    }

    using Key = std::pair<std::uint32_t, std::uint32_t>;
    std::map<std::uint32_t, std::string> names;
    std::map<Key, std::string> memberNames;   // (struct, member)
    std::map<Key, std::uint32_t> decorations; // (target, decoration) -> first literal
    std::map<Key, std::uint32_t> offsets;     // (struct, member)
    std::map<std::uint32_t, SpirvInstruction> types;
    std::map<std::uint32_t, std::uint32_t> constants;
    std::vector<SpirvInstruction> variables;
    std::array<std::uint32_t, 3> localSize{};
};

std::optional<TexelFormat> texelFormat(std::uint32_t imageFormat) {
    switch (imageFormat) {
    case spv::ImageFormatR32ui:
        return TexelFormat::r32ui;
    case spv::ImageFormatRgba32ui:
        return TexelFormat::rgba32ui;
    case spv::ImageFormatR32f:
        return TexelFormat::r32f;
    case spv::ImageFormatRgba32f:
        return TexelFormat::rgba32f;
    case spv::ImageFormatRgba16f:
        return TexelFormat::rgba16f;
    default:
        return std::nullopt;
    }
}

ShaderBinding texelBinding(const ShaderModule& module, const ModuleTables& tables, std::uint32_t variable,
                           const SpirvInstruction& type) {
    const auto op =
        type.operands; // result, sampled type, dimension, depth, arrayed, multisampled, sampled, format
    if (type.opcode != spv::OpTypeImage || op[2] != spv::DimBuffer)
        throw unsupported(module, "a resource that is neither textureBuffer nor imageBuffer");
    if (tables.decorations.at({variable, spv::DecorationDescriptorSet}) != 0)
        throw unsupported(module, "a descriptor set other than 0");
    ShaderBinding binding;
    binding.binding = tables.decorations.at({variable, spv::DecorationBinding});
    binding.name = tables.names.at(variable);
    binding.storage = op[6] == 2;
    binding.integers = tables.types.at(op[1]).opcode == spv::OpTypeInt;
    binding.format = texelFormat(op[7]);
    if (binding.storage && !binding.format)
        throw unsupported(module, fmt::format("'{}' has an unknown layout qualifier", binding.name));
    return binding;
}

void readPushConstants(const ShaderModule& module, const ModuleTables& tables, std::uint32_t block,
                       ShaderInterface& result) {
    const auto members = tables.types.at(block).operands.subspan(1);
    const bool oneStruct = members.size() == 1 && tables.types.at(members[0]).opcode == spv::OpTypeStruct;
    if (!oneStruct) throw unsupported(module, "push constants must be one struct shared with C++");
    const std::uint32_t structure = members[0];
    result.pushBytes = tables.sizeOf(structure);
    result.pushStruct = tables.names.at(structure);
    const auto count = std::uint32_t(tables.types.at(structure).operands.size() - 1);
    for (std::uint32_t m = 0; m < count; ++m)
        result.pushMembers.push_back(
            {tables.memberNames.at({structure, m}), tables.offsets.at({structure, m})});
}

} // namespace

std::span<const ShaderModule> shaderModules() {
    static const auto modules = [] {
        std::array<ShaderModule, std::size(shaders::kModules)> all;
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = {shaders::kModules[i].name, shaders::kModules[i].words};
        return all;
    }();
    return modules;
}

const ShaderModule& shaderModule(std::string_view name) {
    const auto all = shaderModules();
    const auto found = std::ranges::find(all, name, &ShaderModule::name);
    if (found == all.end()) throw Error(ErrorCode::usage, fmt::format("no shader '{}'", name));
    return *found;
}

std::vector<SpirvInstruction> instructions(const ShaderModule& module) {
    constexpr std::size_t kHeaderWords = 5;
    std::vector<SpirvInstruction> result;
    for (auto words = module.words.subspan(kHeaderWords); !words.empty();) {
        const std::size_t count = words[0] >> spv::WordCountShift;
        if (count == 0 || count > words.size()) throw unsupported(module, "malformed SPIR-V");
        result.push_back({words[0] & spv::OpCodeMask, words.subspan(1, count - 1)});
        words = words.subspan(count);
    }
    return result;
}

std::string literalString(const SpirvInstruction& instruction, std::size_t first) {
    std::string text;
    for (const std::uint32_t word : instruction.operands.subspan(first))
        for (int shift = 0; shift < 32; shift += 8) {
            const char c = char(word >> shift & 0xff);
            if (c == 0) return text;
            text += c;
        }
    return text;
}

ShaderInterface reflect(const ShaderModule& module) {
    const ModuleTables tables(module);
    ShaderInterface result;
    result.localSize = tables.localSize;
    for (const SpirvInstruction& variable : tables.variables) { // type, result, storage class
        const std::uint32_t pointee = tables.types.at(variable.operands[0]).operands[2];
        switch (variable.operands[2]) {
        case spv::StorageClassUniformConstant:
            result.bindings.push_back(
                texelBinding(module, tables, variable.operands[1], tables.types.at(pointee)));
            break;
        case spv::StorageClassPushConstant:
            readPushConstants(module, tables, pointee, result);
            break;
        case spv::StorageClassUniform:
        case spv::StorageClassStorageBuffer:
            throw unsupported(module, "a resource that is neither textureBuffer nor imageBuffer");
        default:
            break;
        }
    }
    std::ranges::sort(result.bindings, {}, &ShaderBinding::binding);
    for (std::size_t i = 0; i < result.bindings.size(); ++i)
        if (result.bindings[i].binding != i)
            throw unsupported(module, "binding numbers leave a gap or repeat");
    return result;
}

} // namespace slant
