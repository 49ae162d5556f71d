// Every shader uses only arithmetic that a driver must carry out as written, so that CPU and device agree to
// the bit: nothing that it may fuse or rearrange, and no function whose result is up to the driver.
#include "compute/spirv.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

namespace slant {
namespace {

/// Functions of integers, or found to equal C++ to the bit on lavapipe.
const std::set<std::uint32_t> kExactFunctions{
    GLSLstd450FAbs,      GLSLstd450SAbs,         GLSLstd450FSign,          GLSLstd450SSign,
    GLSLstd450Floor,     GLSLstd450Ceil,         GLSLstd450Trunc,          GLSLstd450RoundEven,
    GLSLstd450Fract,     GLSLstd450Sqrt,         GLSLstd450InverseSqrt,    GLSLstd450FMin,
    GLSLstd450FMax,      GLSLstd450FClamp,       GLSLstd450UMin,           GLSLstd450UMax,
    GLSLstd450UClamp,    GLSLstd450SMin,         GLSLstd450SMax,           GLSLstd450SClamp,
    GLSLstd450FMix,      GLSLstd450Step,         GLSLstd450Length,         GLSLstd450Distance,
    GLSLstd450Normalize, GLSLstd450PackHalf2x16, GLSLstd450UnpackHalf2x16, GLSLstd450FindILsb,
    GLSLstd450FindUMsb};

/// What must be written out instead.
const std::map<std::uint32_t, std::string> kForbidden{{spv::OpFRem, "FRem"},
                                                      {spv::OpFMod, "mod"},
                                                      {spv::OpVectorTimesMatrix, "vector * matrix"},
                                                      {spv::OpMatrixTimesVector, "matrix * vector"},
                                                      {spv::OpMatrixTimesMatrix, "matrix * matrix"},
                                                      {spv::OpMatrixTimesScalar, "matrix * scalar"},
                                                      {spv::OpOuterProduct, "outerProduct"}};

const std::set<std::uint32_t> kContractible{spv::OpFAdd, spv::OpFSub, spv::OpFMul,
                                            spv::OpFDiv, spv::OpDot,  spv::OpVectorTimesScalar};

/// What makes the results of a module undetermined; empty if nothing does.
std::vector<std::string> objections(const ShaderModule& module) {
    std::set<std::uint32_t> decorated;
    std::vector<std::string> found;
    for (const SpirvInstruction& i : instructions(module)) {
        const auto op = i.operands; // of an operation: type, result, ...
        if (i.opcode == spv::OpDecorate && op[1] == spv::DecorationNoContraction) decorated.insert(op[0]);
        if (kContractible.contains(i.opcode) && !decorated.contains(op[1]))
            found.push_back(fmt::format("{}: result {} may be contracted", module.name, op[1]));
        if (const auto bad = kForbidden.find(i.opcode); bad != kForbidden.end())
            found.push_back(fmt::format("{}: {}", module.name, bad->second));
        if (i.opcode == spv::OpExtInst && !kExactFunctions.contains(op[3]))
            found.push_back(fmt::format("{}: built-in function {}", module.name, op[3]));
    }
    return found;
}

TEST(Spirv, everyShaderIsExact) {
    ASSERT_FALSE(shaderModules().empty());
    for (const ShaderModule& module : shaderModules())
        for (const std::string& objection : objections(module)) ADD_FAILURE() << objection;
}

std::uint32_t head(std::uint32_t words, std::uint32_t opcode) {
    return words << 16 | opcode;
}

/// Objections to a module of these instructions (float: id 1, operands: ids 2 and 3).
std::size_t objectionCount(const std::vector<std::uint32_t>& words) {
    std::vector<std::uint32_t> module{spv::MagicNumber, 0x10500, 0, 100, 0, head(3, spv::OpTypeFloat), 1, 32};
    module.insert(module.end(), words.begin(), words.end());
    return objections({"made up", module}).size();
}

TEST(Spirv, theCheckFindsWhatIsInexact) {
    const std::vector<std::uint32_t> add{head(5, spv::OpFAdd), 1, 4, 2, 3};
    std::vector<std::uint32_t> decoratedAdd{head(3, spv::OpDecorate), 4, spv::DecorationNoContraction};
    decoratedAdd.insert(decoratedAdd.end(), add.begin(), add.end());
    EXPECT_EQ(objectionCount(add), 1u);
    EXPECT_EQ(objectionCount(decoratedAdd), 0u);
    EXPECT_EQ(objectionCount({head(5, spv::OpMatrixTimesVector), 1, 4, 2, 3}), 1u);
    EXPECT_EQ(objectionCount({head(6, spv::OpExtInst), 1, 4, 9, GLSLstd450Sqrt, 2}), 0u);
    EXPECT_EQ(objectionCount({head(6, spv::OpExtInst), 1, 4, 9, GLSLstd450Exp, 2}), 1u);
    EXPECT_EQ(objectionCount({head(8, spv::OpExtInst), 1, 4, 9, GLSLstd450Fma, 2, 3, 3}), 1u);
}

TEST(Spirv, reflectsTheInterface) {
    const ShaderInterface interface = reflect(shaderModule("scan_reduce"));
    EXPECT_EQ(interface.localSize, (std::array<std::uint32_t, 3>{64, 1, 1}));
    ASSERT_EQ(interface.bindings.size(), 2u);
    EXPECT_EQ(interface.bindings[0].name, "items");
    EXPECT_FALSE(interface.bindings[0].storage);
    EXPECT_TRUE(interface.bindings[0].integers);
    EXPECT_EQ(interface.bindings[1].name, "sums");
    EXPECT_TRUE(interface.bindings[1].storage);
    EXPECT_EQ(interface.bindings[1].format, TexelFormat::r32ui);
}

} // namespace
} // namespace slant
