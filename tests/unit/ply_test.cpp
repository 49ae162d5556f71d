#include "base/error.h"
#include "scene/ply.h"
#include "scene/scene_files.h"
#include "support/ply_text.h"
#include "support/temp_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string errorOf(const std::string& bytes) {
    try {
        parsePly(bytes, "m.ply");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::badInput);
        return error.what();
    }
    return "";
}

/// A triangle and a quad over five vertices with everything that is read, and more that is skipped.
void checkSample(const PlyMeshes& ply) {
    ASSERT_TRUE(ply.triangles);
    ASSERT_TRUE(ply.patches);
    EXPECT_EQ(ply.triangles->kind, Mesh::Kind::triangles);
    EXPECT_EQ(ply.patches->kind, Mesh::Kind::bilinearPatches);
    EXPECT_THAT(ply.triangles->indices, ElementsAre(1, 4, 2));
    EXPECT_THAT(ply.patches->indices, ElementsAre(0, 1, 3, 2)); // rows, not around the rim
    EXPECT_EQ(ply.skippedFaces, 1u);
    for (const auto& mesh : {*ply.triangles, *ply.patches}) {
        EXPECT_THAT(mesh.positions, ElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0),
                                                glm::vec3(0, 1, 0.25f), glm::vec3(2, 0.5f, -1)));
        EXPECT_THAT(mesh.normals, ElementsAre(glm::vec3(0, 0, 1), glm::vec3(0, 0, 1), glm::vec3(0, 0, 1),
                                              glm::vec3(0, 0, 1), glm::vec3(1, 0, 0)));
        EXPECT_THAT(mesh.uvs, ElementsAre(glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1),
                                          glm::vec2(0.5f, 0.75f)));
    }
}

TEST(Ply, isTheSameInEveryEncoding) {
    for (const auto format :
         {test::PlyFormat::ascii, test::PlyFormat::littleEndian, test::PlyFormat::bigEndian}) {
        SCOPED_TRACE(int(format));
        checkSample(parsePly(test::samplePly(format), "m.ply"));
    }
}

TEST(Ply, normalsThatAreNotFiniteAreNone) {
    const PlyMeshes ply =
        parsePly("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                 "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0 0 0 0 1\n1 0 0 nan nan nan\n0 1 0 0 0 1\n3 0 1 2\n",
                 "m.ply");
    EXPECT_EQ(ply.lostNormals, 1u);
    EXPECT_THAT(ply.triangles.value().normals,
                ElementsAre(glm::vec3(0, 0, 1), glm::vec3(0), glm::vec3(0, 0, 1)));
}

TEST(Ply, isReadThroughGzip) {
    const test::TempDir dir;
    const std::string path = dir.file("m.bin"); // by content, not by name
    test::writeText(path, test::gzipped(test::samplePly(test::PlyFormat::bigEndian)));
    checkSample(parsePly(readBytes(path, {}), path));

    const std::string packed = test::gzipped(test::samplePly(test::PlyFormat::ascii));
    test::writeText(path, packed + packed); // members follow one another, as gzip allows
    EXPECT_EQ(readBytes(path, {}).size(), 2 * test::samplePly(test::PlyFormat::ascii).size());
    test::writeText(path, packed.substr(0, packed.size() / 2));
    EXPECT_THROW(readBytes(path, {}), Error);
    std::string damaged = packed;
    damaged[packed.size() / 2] = char(damaged[packed.size() / 2] ^ 0x55);
    test::writeText(path, damaged);
    EXPECT_THROW(readBytes(path, {}), Error);
}

TEST(Ply, takesTextureCoordinatesByAnyOfTheirNames) {
    for (const auto& [u, v] :
         {std::pair("u", "v"), {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}) {
        const PlyMeshes ply = parsePly(
            fmt::format(
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
                "z\n"
                "property float {}\nproperty float {}\nelement face 1\nproperty list uchar int vertex_index\n"
                "end_header\n0 0 0 .1 .2\n1 0 0 .3 .4\n0 1 0 .5 .6\n3 0 1 2",
                u, v),
            "m.ply");
        EXPECT_THAT(ply.triangles.value().uvs,
                    ElementsAre(glm::vec2(.1f, .2f), glm::vec2(.3f, .4f), glm::vec2(.5f, .6f)));
        EXPECT_THAT(ply.triangles.value().normals, IsEmpty());
        EXPECT_FALSE(ply.patches);
    }
}

TEST(Ply, saysWhatIsWrongAndWhere) {
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n";
    const struct {
        std::string bytes, message;
    } cases[] = {
        {"", "m.ply:1: this is not a PLY file"},
        {"obj\n", "m.ply:1: this is not a PLY file"},
        {"ply\n", "m.ply:1: the file ends within its PLY header"},
        {"ply\nformat ascii 2.0\n", "m.ply:2: unknown PLY version '2.0'"},
        {"ply\nformat binary 1.0\n", "m.ply:2: unknown PLY format 'binary'"},
        {"ply\nelement vertex -1\n", "m.ply:2: '-1' is not a number of elements"},
        {"ply\nelement vertex 99999999999999999999999\n",
         "m.ply:2: '99999999999999999999999' is not a number of elements"},
        {"ply\nproperty float x\n", "m.ply:2: a property stands before any element"},
        {"ply\nelement vertex 1\nproperty real x\n", "m.ply:3: unknown PLY type 'real'"},
        {"ply\nelement vertex 1\nproperty list float\n", "m.ply:3: unknown PLY type ''"},
        {"ply\ntexture a.png\n", "m.ply:2: unknown keyword 'texture' in the PLY header"},
        {"ply\nelement vertex 1\nend_header\n", "m.ply:3: the PLY header names no format"},
        {"ply\nformat ascii 1.0\nend_header\n", "m.ply:4: the file has no vertices or no faces"},
        {"ply\nformat ascii 1.0\nelement vertex 2147483647\nproperty float x\nproperty float y\nproperty "
         "float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0",
         "m.ply:10: the file is too short for 2147483647 vertex rows"},
        {head + vertices + "3 0 1 3\n", "m.ply:13: face 0 has index 3, but there are 3 vertices"},
        {head + vertices + "3 0 1 -2\n", "m.ply:13: face 0 has index -2, but there are 3 vertices"},
        {head + vertices + "3 0 1 1.5\n", "m.ply:13: face 0 has index 1.5, but there are 3 vertices"},
        {head + vertices + "3 0 1", "m.ply:13: the file ends too early"},
        {head + vertices + "1000000 0 1",
         "m.ply:13: a list of 'vertex_indices' cannot have 1000000 items here"},
        {head + vertices + "-3 0 1 2", "m.ply:13: a list of 'vertex_indices' cannot have -3 items here"},
        {head + vertices + "2 0 1", "m.ply:13: the file has no face of three or four vertices"},
        {head + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2", "m.ply:11: vertex 1 has a number that is not finite"},
        {head + "0 0 0\n1 0 1e300\n0 1 0\n3 0 1 2", "m.ply:11: vertex 1 has a number that is not finite"},
        {head + "0 0 0\n1 z 0\n0 1 0\n3 0 1 2", "m.ply:11: expected a number, found 'z'"},
    };
    for (const auto& c : cases) EXPECT_EQ(errorOf(c.bytes), c.message);
    const std::string binary = test::samplePly(test::PlyFormat::littleEndian);
    EXPECT_THAT(errorOf(binary.substr(0, binary.size() - 2)),
                testing::MatchesRegex("m.ply: .* \\(at byte [0-9]+\\)"));
}

} // namespace
} // namespace slant
