// Makes a shader compute what is written: marks every floating-point operation of a SPIR-V module with
// NoContraction, as if each variable in GLSL were `precise`. Drivers then neither fuse nor rearrange, and on
// lavapipe the results equal those of C++ compiled with -ffp-contract=off, to the bit.
#pragma once
#include "compute/spirv.h"

namespace slant {

/// Whether NoContraction means something for the result of this instruction (SPIR-V 1.6, 3.20).
bool isFloatArithmetic(std::uint32_t opcode);

/// The module's words with the decorations.
std::vector<std::uint32_t> withExactArithmetic(const ShaderModule& module);

} // namespace slant
