// Random damage to a valid scene and to valid PLY files: the readers succeed or throw Error. The seeds are
// fixed; a failure names its seed.
#include "support/damage.h"
#include "support/fuzz_targets.h"
#include "support/make_picture.h"
#include "support/ply_text.h"

#include <gtest/gtest.h>

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

TEST(SceneMutations, neverDoWorseThanAnError) {
    const auto [read, refused] = test::survive(test::fuzzScene, kScene, 1000);
    EXPECT_GT(read, 20); // the damage reaches more than the first check
    EXPECT_GT(refused, 500);
}

TEST(SceneMutations, neverBreakThePlyReader) {
    for (const auto format :
         {test::PlyFormat::ascii, test::PlyFormat::littleEndian, test::PlyFormat::bigEndian}) {
        const auto [read, refused] = test::survive(test::fuzzPly, test::samplePly(format), 1000);
        EXPECT_GT(read, 20);
        EXPECT_GT(refused, 300);
    }
}

TEST(SceneMutations, neverBreakThePictureReaders) {
    for (const auto kind :
         {test::PictureKind::jpeg, test::PictureKind::tga, test::PictureKind::hdr, test::PictureKind::pfm}) {
        const auto [read, refused] = test::survive(test::fuzzPicture, test::pictureBytes(kind), 300);
        EXPECT_GT(read + refused, 0);
    }
}

TEST(SceneMutations, neverBreakTheReadersOfSmallFiles) {
    const std::string seeds = SLANT_SOURCE_DIR "/tests/fuzz/seeds/";
    for (const auto& [file, target] : {std::pair("lens/dgauss-50mm.dat", &test::fuzzLens),
                                       {"aperture/polygon", &test::fuzzAperture},
                                       {"spd/lines.spd", &test::fuzzSpd},
                                       {"scene/older.pbrt", &test::fuzzScene}}) {
        SCOPED_TRACE(file);
        const auto [read, refused] = test::survive(target, test::readText(seeds + file), 400);
        EXPECT_GT(read, 5);
        EXPECT_GT(refused, 5);
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
