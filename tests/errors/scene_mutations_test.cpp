// Random damage to a valid scene and to valid PLY files: the readers succeed or throw Error. The seeds are
// fixed; a failure names its seed.
#include "support/fuzz_targets.h"
#include "support/ply_text.h"

#include <gtest/gtest.h>
#include <random>

namespace slant {
namespace {

const std::string kScene = R"(LookAt 0 0 -5  0 0 0  0 1 0 Scale -1 1 1
Camera "perspective" "float fov" 40 "float lensradius" [0.1] "float focaldistance" [5] "float screenwindow" [-1 1 -1 1]
Film "rgb" "integer xresolution" [64] "float cropwindow" [0 .5 0 1] "string filename" "o\"ut.exr"
Sampler "halton" "integer pixelsamples" 8 # comment
PixelFilter "mitchell" "float B" .3 Integrator "path" "integer maxdepth" 1 Option "seed" 4
WorldBegin
Attribute "shape" "float radius" 2 CoordinateSystem "a" CoordSysTransform "camera"
LightSource "distant" "point3 from" [0 10 0] "rgb L" [1 2 3] LightSource "infinite" "blackbody L" 3000
Texture "t" "spectrum" "checkerboard" "string mapping" "planar" "vector3 v1" [1 0 0] "rgb tex1" [.1 .2 .3] "texture tex2" "u"
Texture "u" "spectrum" "scale" "float scale" .5
MakeNamedMaterial "m" "string type" "coateddiffuse" "texture reflectance" "t" "spectrum eta" [300 1.5 900 1.5]
AttributeBegin NamedMaterial "m" Translate 0 -1 0 Rotate 30 0 1 0 ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 2 3 4 1]
  Shape "trianglemesh" "point3 P" [-9 0 -9  9 0 -9  9 0 9  -9 0 9] "integer indices" [0 1 2 0 2 3]
    "point2 uv" [0 0 1 0 1 1 0 1] "normal N" [0 1 0 0 1 0 0 1 0 0 1 0]
AttributeEnd
AreaLightSource "diffuse" "rgb L" [5 5 5] "bool twosided" true Shape "sphere"
ObjectBegin "thing" Material "conductor" "float roughness" .2 Shape "disk" ObjectEnd ObjectInstance "thing"
)";

/// A few bytes flipped, replaced, inserted, removed or doubled, perhaps the end cut off.
std::string damaged(std::string bytes, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return std::size_t(random()) % n; };
    for (std::size_t edits = 1 + below(4); edits > 0 && !bytes.empty(); --edits) {
        const std::size_t place = below(bytes.size()), length = std::min(1 + below(12), bytes.size() - place);
        constexpr char kTelling[] = "\"[]#-.e9 \n\0\xff";
        switch (below(6)) {
        case 0:
            bytes[place] = char(bytes[place] ^ (1 << below(8)));
            break;
        case 1:
            bytes[place] = kTelling[below(sizeof kTelling - 1)];
            break;
        case 2:
            bytes.insert(place, 1, kTelling[below(sizeof kTelling - 1)]);
            break;
        case 3:
            bytes.erase(place, length);
            break;
        case 4:
            bytes.insert(place, bytes.substr(below(bytes.size()), length));
            break;
        default:
            if (below(4) == 0) bytes.resize(place);
        }
    }
    return bytes;
}

/// Counts of variants that were read and refused.
template <typename Target>
std::pair<int, int> survive(Target target, const std::string& valid, int variants) {
    EXPECT_TRUE(target(valid));
    std::pair<int, int> counts{0, 0};
    for (int seed = 0; seed < variants; ++seed) {
        std::mt19937 random{unsigned(seed)};
        SCOPED_TRACE(seed);
        EXPECT_NO_THROW(++(target(damaged(valid, random)) ? counts.first : counts.second));
    }
    return counts;
}

TEST(SceneMutations, neverDoWorseThanAnError) {
    const auto [read, refused] = survive(test::fuzzScene, kScene, 1000);
    EXPECT_GT(read, 20); // the damage reaches more than the first check
    EXPECT_GT(refused, 500);
}

TEST(SceneMutations, neverBreakThePlyReader) {
    for (const auto format :
         {test::PlyFormat::ascii, test::PlyFormat::littleEndian, test::PlyFormat::bigEndian}) {
        const auto [read, refused] = survive(test::fuzzPly, test::samplePly(format), 1000);
        EXPECT_GT(read, 20);
        EXPECT_GT(refused, 300);
    }
}

TEST(SceneMutations, everyPrefixIsReadOrRefused) {
    for (std::size_t length = 0; length < kScene.size(); ++length)
        EXPECT_NO_THROW(test::fuzzScene(kScene.substr(0, length)));
    const std::string ply = test::samplePly(test::PlyFormat::littleEndian);
    for (std::size_t length = 0; length < ply.size(); ++length)
        EXPECT_FALSE(test::fuzzPly(ply.substr(0, length))) << length;
}

} // namespace
} // namespace slant
