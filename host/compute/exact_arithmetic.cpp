#include "compute/exact_arithmetic.h"

#include <algorithm>
#include <spirv/unified1/spirv.hpp>

namespace slant {

bool isFloatArithmetic(std::uint32_t opcode) {
    switch (opcode) {
    case spv::OpFAdd:
    case spv::OpFSub:
    case spv::OpFMul:
    case spv::OpFDiv:
    case spv::OpFRem:
    case spv::OpFMod:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
    case spv::OpVectorTimesMatrix:
    case spv::OpMatrixTimesVector:
    case spv::OpMatrixTimesMatrix:
    case spv::OpOuterProduct:
    case spv::OpDot:
        return true;
    default:
        return false;
    }
}

std::vector<std::uint32_t> withExactArithmetic(const ShaderModule& module) {
    // Decorations stand behind names and before types: the new ones go behind the last.
    std::size_t place = 0;
    std::vector<std::uint32_t> decorations;
    for (const SpirvInstruction& i : instructions(module)) {
        if (i.opcode == spv::OpDecorate || i.opcode == spv::OpMemberDecorate)
            place = std::size_t(i.operands.data() + i.operands.size() - module.words.data());
        if (isFloatArithmetic(i.opcode))
            decorations.insert(decorations.end(), {3u << spv::WordCountShift | spv::OpDecorate, i.operands[1],
                                                   spv::DecorationNoContraction});
    }
    std::vector<std::uint32_t> words(module.words.begin(), module.words.end());
    words.insert(words.begin() + std::ptrdiff_t(place), decorations.begin(), decorations.end());
    return words;
}

} // namespace slant
