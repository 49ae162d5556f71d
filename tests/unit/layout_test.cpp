// Structs of push constants lie in memory as the shaders see them. Add new ones to kLayouts: the test fails
// on a shader whose struct it does not know.
#include "compute/spirv.h"
#include "shared/layer_map.h"
#include "shared/radix.h"
#include "shared/reconstruct.h"
#include "shared/scan.h"
#include "shared/shading.h"
#include "shared/window.h"

#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>

namespace slant {
namespace {

struct Layout {
    std::string name;
    std::size_t bytes;
    std::vector<ShaderMember> members;
};

#define STRUCT(type, ...)                                                                                    \
    Layout {                                                                                                 \
#type, sizeof(type), {                                                                               \
            __VA_ARGS__                                                                                      \
        }                                                                                                    \
    }
#define MEMBER(type, member)                                                                                 \
    ShaderMember {                                                                                           \
#member, offsetof(type, member)                                                                      \
    }

const Layout kLayouts[] = {
    STRUCT(ScanPush, MEMBER(ScanPush, count), MEMBER(ScanPush, hasOffsets)),
    STRUCT(RadixPush, MEMBER(RadixPush, count), MEMBER(RadixPush, chunks), MEMBER(RadixPush, shift),
           MEMBER(RadixPush, mask)),
    STRUCT(BinPush, MEMBER(BinPush, grid), MEMBER(BinPush, occlusion), MEMBER(BinPush, density),
           MEMBER(BinPush, regionMin), MEMBER(BinPush, regionMax), MEMBER(BinPush, marginPx),
           MEMBER(BinPush, firstSample), MEMBER(BinPush, count), MEMBER(BinPush, brickTotal)),
    STRUCT(RefocusPush, MEMBER(RefocusPush, recordCount), MEMBER(RefocusPush, brickCount),
           MEMBER(RefocusPush, slopeShift)),
    STRUCT(TexelPush, MEMBER(TexelPush, texels), MEMBER(TexelPush, count)),
    STRUCT(ShadingPush, MEMBER(ShadingPush, size), MEMBER(ShadingPush, band)),
    STRUCT(ShadedPush, MEMBER(ShadedPush, size), MEMBER(ShadedPush, firstRow), MEMBER(ShadedPush, lastRow),
           MEMBER(ShadedPush, count)),
    STRUCT(CountPush, MEMBER(CountPush, count)),
    STRUCT(OutputPush, MEMBER(OutputPush, grid), MEMBER(OutputPush, outputs), MEMBER(OutputPush, lensCells),
           MEMBER(OutputPush, lensScale), MEMBER(OutputPush, firstOutput), MEMBER(OutputPush, count),
           MEMBER(OutputPush, firstGroup), MEMBER(OutputPush, groupCount), MEMBER(OutputPush, brickTotal),
           MEMBER(OutputPush, marginPx), MEMBER(OutputPush, baseRadiusPx), MEMBER(OutputPush, groupBits),
           MEMBER(OutputPush, takenBits)),
    STRUCT(FilterPush, MEMBER(FilterPush, regionSize), MEMBER(FilterPush, tableLength),
           MEMBER(FilterPush, filmSize), MEMBER(FilterPush, firstRow), MEMBER(FilterPush, rowCount),
           MEMBER(FilterPush, regionRow), MEMBER(FilterPush, firstPlane), MEMBER(FilterPush, planeCount),
           MEMBER(FilterPush, groupSize)),
    STRUCT(WindowPush, MEMBER(WindowPush, search), MEMBER(WindowPush, outputs), MEMBER(WindowPush, lensCells),
           MEMBER(WindowPush, lensScale), MEMBER(WindowPush, firstOutput), MEMBER(WindowPush, count)),
    STRUCT(ReducePush, MEMBER(ReducePush, size), MEMBER(ReducePush, source), MEMBER(ReducePush, target),
           MEMBER(ReducePush, surfaceGap), MEMBER(ReducePush, code)),
    STRUCT(MapLookupPush, MEMBER(MapLookupPush, outputs), MEMBER(MapLookupPush, map),
           MEMBER(MapLookupPush, firstGroup), MEMBER(MapLookupPush, count), MEMBER(MapLookupPush, groupBits),
           MEMBER(MapLookupPush, sparseBits), MEMBER(MapLookupPush, lensCells),
           MEMBER(MapLookupPush, lensScale)),
    STRUCT(LowerBoundPush, MEMBER(LowerBoundPush, keyCount), MEMBER(LowerBoundPush, count)),
};

/// How a shader's push constants differ from the struct of C++; empty if they do not.
std::string difference(const ShaderInterface& shader, const Layout& layout) {
    if (shader.pushMembers.size() != layout.members.size()) return "number of members";
    for (std::size_t i = 0; i < layout.members.size(); ++i) {
        const ShaderMember &a = shader.pushMembers[i], &b = layout.members[i];
        if (a.name != b.name || a.offset != b.offset)
            return "shader " + a.name + " at " + std::to_string(a.offset) + ", C++ " + b.name + " at " +
                   std::to_string(b.offset);
    }
    return shader.pushBytes == layout.bytes ? "" : "size";
}

TEST(Layout, ofPushConstantsIsTheSameInCppAndGlsl) {
    for (const ShaderModule& module : shaderModules()) {
        const ShaderInterface shader = reflect(module);
        if (shader.pushBytes == 0) continue;
        const auto layout = std::ranges::find(kLayouts, shader.pushStruct, &Layout::name);
        ASSERT_NE(layout, std::end(kLayouts))
            << module.name << ": add " << shader.pushStruct << " to kLayouts";
        EXPECT_EQ(difference(shader, *layout), "") << module.name;
    }
}

TEST(Layout, theCheckFindsDifferences) {
    const ShaderInterface shader = reflect(shaderModule("scan_reduce"));
    Layout layout = kLayouts[0];
    EXPECT_EQ(difference(shader, layout), "");
    layout.members[1].offset += 4;
    EXPECT_EQ(difference(shader, layout), "shader hasOffsets at 4, C++ hasOffsets at 8");
    layout = kLayouts[0];
    layout.bytes += 4;
    EXPECT_EQ(difference(shader, layout), "size");
    layout.members.pop_back();
    EXPECT_EQ(difference(shader, layout), "number of members");
}

} // namespace
} // namespace slant
