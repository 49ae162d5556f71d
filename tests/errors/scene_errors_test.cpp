// Every kind of wrong scene text ends in one line with the place and what would be right.
#include "support/scene_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::errorOf;
using testing::HasSubstr;

struct Case {
    std::string text, message; // without the file's name
};

void check(const std::vector<Case>& cases, const std::string& before = "") {
    for (const Case& c : cases) EXPECT_EQ(errorOf(before + c.text), "s.pbrt" + c.message) << c.text;
}

TEST(SceneErrors, structure) {
    check({
        {"", ": the file has no WorldBegin"},
        {"# nothing\n", ": the file has no WorldBegin"},
        {"Shape \"sphere\"", ":1:1: Shape must stand after WorldBegin"},
        {"WorldBegin\nFilm \"rgb\"", ":2:1: Film must stand before WorldBegin"},
        {"WorldBegin WorldBegin", ":1:12: WorldBegin must stand before WorldBegin"},
        {"WorldBgin", ":1:1: unknown directive 'WorldBgin', did you mean 'WorldBegin'?"},
        {"worldbegin", ":1:1: unknown directive 'worldbegin', did you mean 'WorldBegin'?"},
        {"\x89PNG\r\n", ":1:1: unknown directive '\\x89PNG'"},
        {std::string("\0\0\0", 3), ":1:1: unknown directive '\\x00\\x00\\x00'"},
        {"\"perspective\"", ":1:1: unknown directive \"perspective\""},
        {"[", ":1:1: unknown directive '['"},
        {"Camera", ":1:7: expected a string in quotes, found the end of the file"},
        {"Camera perspective", ":1:8: expected a string in quotes, found 'perspective'"},
        {"WorldBegin AttributeEnd", ":1:12: AttributeEnd without AttributeBegin"},
        {"WorldBegin ObjectEnd", ":1:12: ObjectEnd without ObjectBegin"},
        {"WorldBegin\n AttributeBegin", ":2:2: this AttributeBegin is never closed"},
        {"WorldBegin\nObjectBegin \"a\"", ":2:1: this ObjectBegin is never closed"},
        {"WorldBegin\nObjectBegin \"a\"\nAttributeEnd",
         ":3:1: AttributeEnd within the ObjectBegin of line 2"},
        {"WorldBegin\nObjectBegin \"a\"\nAttributeBegin ObjectEnd",
         ":3:16: ObjectEnd within the AttributeBegin of line 3"},
        {"WorldBegin ObjectBegin \"a\" ObjectBegin \"b\"", ":1:28: ObjectBegin within ObjectBegin"},
        {"WorldBegin ObjectBegin \"a\" ObjectInstance \"a\"", ":1:28: ObjectInstance within ObjectBegin"},
        {"WorldBegin ObjectBegin \"a\" ObjectEnd ObjectBegin \"a\"",
         ":1:38: the object 'a' is defined twice"},
        {"WorldBegin ObjectBegin \"tree\" ObjectEnd\nObjectInstance \"treee\"",
         ":2:1: there is no object 'treee', did you mean 'tree'?"},
        {"Attribute \"shapes\" WorldBegin",
         ":1:11: unknown attribute target \"shapes\", did you mean 'shape'?"},
        {"Option \"sed\" 1 WorldBegin", ":1:8: unknown option \"sed\", did you mean 'seed'?"},
        {"Option \"seed\"", ":1:14: expected the value of option \"seed\", found the end of the file"},
        {"Option \"forcediffuse\" true WorldBegin",
         ":1:23: option \"forcediffuse\" is supported only as false"},
        {"ColorSpace \"aces\" WorldBegin",
         ":1:12: colour space \"aces\" is none of aces2065-1, dci-p3, rec2020 and srgb"},
        {"WorldBegin MediumInterface \"\" \"fog\"", ":1:31: participating media are not supported"},
        {"MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" WorldBegin",
         ":1:1: participating media are not supported"},
    });
    std::string deep = "WorldBegin\n";
    for (int i = 0; i < 1001; ++i) deep += "AttributeBegin\n";
    EXPECT_EQ(errorOf(deep), "s.pbrt:1002:1: attributes are nested more than 1000 deep");
}

TEST(SceneErrors, parameterLists) {
    const std::string shape = "WorldBegin\nShape \"sphere\" ";
    check(
        {
            {"\"float radius\"", ":2:30: expected a number, found the end of the file"},
            {"\"float radius\" [1", ":2:31: this '[' is never closed"},
            {"\"float radius\" []", ":2:16: parameter 'radius' has no values"},
            {"\"float radius\" [1 2]", ":2:16: 'radius' must have one value"},
            {"\"float radius\" \"1\"", ":2:31: expected a number, found \"1\""},
            {"\"float radius\" [true]", ":2:32: expected a number, found 'true'"},
            {"\"float radius\" 1 2", ":2:33: unknown directive '2'"},
            {"\"float radius\" nan", ":2:31: 'nan' is not a finite number in the range of a float"},
            {"\"float radius\" 1e50", ":2:31: '1e50' is not a finite number in the range of a float"},
            {"\"float radius\" [[1]]", ":2:32: expected a number, found '['"},
            {"\"radius\" 1", ":2:16: expected a parameter such as \"float radius\", found \"radius\""},
            {"\"\" 1", ":2:16: expected a parameter such as \"float radius\", found \"\""},
            {"\"float the radius\" 1",
             ":2:16: expected a parameter such as \"float radius\", found \"float the radius\""},
            {"\"flaot radius\" 1", ":2:16: unknown parameter type 'flaot', did you mean 'float'?"},
            {"\"color radius\" 1", ":2:16: 'radius' has 1 numbers, not a multiple of 3 as type rgb needs"},
            {"\"integer radius\" 1",
             ":2:16: 'radius' of Shape \"sphere\" is given as integer, but must be float"},
            {"\"integer radius\" 1.5", ":2:33: expected an integer, found '1.5'"},
            {"\"float raduis\" 1", ":2:16: Shape \"sphere\" has no parameter 'raduis', or none that is "
                                   "supported, did you mean 'radius'?"},
            {"\"float height\" 1",
             ":2:16: Shape \"sphere\" has no parameter 'height', or none that is supported"},
            {"\"float radius\" 0", ":2:16: 'radius' is 0, but must be above 0"},
            {"\"float radius\" -1", ":2:16: 'radius' is -1, but must be above 0"},
            {"\"float zmin\" 3 \"float zmax\" 4",
             ":2:1: nothing is left of this sphere between zmin and zmax, 0 and phimax"},
            {"\"texture alpha\" \"holes\"", ":2:16: there is no float texture 'holes'"},
            {"\"float radius\" 1 \"unclosed", ":2:33: this string has no closing quote in its line"},
        },
        shape);
    check({{"\"bool remaproughness\" \"no\"", ":2:44: expected true or false, found \"no\""},
           {"\"bool remaproughness\" 1", ":2:44: expected true or false, found '1'"}},
          "WorldBegin\nMaterial \"conductor\" ");
}

TEST(SceneErrors, shapes) {
    check(
        {
            {"\"spher\"", ":2:1: shape \"spher\" is not supported, did you mean 'sphere'?"},
            {"\"curve\"", ":2:1: curves are not supported: a sample has one depth, and strands thinner than "
                          "a pixel have many"},
            {"\"cylinder\" \"float zmin\" 1",
             ":2:1: nothing is left of this shape between its ends, 0 and phimax"},
            {"\"cone\" \"float height\" -1", ":2:14: 'height' is -1, but must be above 0"},
            {"\"paraboloid\" \"float zmax\" 0",
             ":2:1: nothing is left of this shape between its ends, 0 and phimax"},
            {"\"hyperboloid\" \"point3 p2\" [0 0 2]",
             ":2:1: nothing is left of this shape between its ends, 0 and phimax"},
            {"\"hyperboloid\" \"point3 p2\" [1 2 0]",
             ":2:1: nothing is left of this shape between its ends, 0 and phimax"},
            {"\"loopsubdiv\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer levels\" 15",
             ":2:51: 1 triangles cut 15 times are too many"},
            {"\"disk\" \"float innerradius\" 1",
             ":2:1: nothing is left of this disk between its radii, 0 and phimax"},
            {"\"trianglemesh\"", ":2:1: Shape \"trianglemesh\" needs \"point3 P\""},
            {"\"trianglemesh\" \"point3 P\" [0 0 0 1]",
             ":2:22: 'P' has 4 numbers, not a multiple of 3 as type point3 needs"},
            {"\"trianglemesh\" \"point3 P\" [0 0 0 1 1 1]",
             ":2:1: Shape \"trianglemesh\" needs \"integer indices\""},
            {"\"trianglemesh\" \"point3 P\" [0 0 0 1 1 1 2 2 2] \"integer indices\" [0 1]",
             ":2:53: 'indices' has 2 numbers, not a multiple of 3"},
            {"\"trianglemesh\" \"point3 P\" [0 0 0 1 1 1 2 2 2] \"integer indices\" [0 1 3]",
             ":2:53: number 3 of 'indices' is 3, but there are 3 vertices"},
            {"\"trianglemesh\" \"point3 P\" [0 0 0 1 1 1 2 2 2] \"integer indices\" [0 -1 2]",
             ":2:53: number 2 of 'indices' is -1, but there are 3 vertices"},
            {"\"trianglemesh\" \"point3 P\" [0 0 0 1 1 1 2 2 2] \"normal N\" [0 0 1]",
             ":2:53: 'N' has 1 items, but there are 3 vertices"},
            {"\"bilinearmesh\" \"point3 P\" [0 0 0 1 1 1 2 2 2 3 3 3] \"point2 uv\" [0 0]",
             ":2:59: 'uv' has 1 items, but there are 4 vertices"},
            {"\"trianglemesh\" \"point3 P\" [0 0 0 1 1 1 2 2 2] \"vector3 Q\" [0 0 1]",
             ":2:53: Shape \"trianglemesh\" has no parameter 'Q', or none that is supported"},
            {"\"plymesh\"", ":2:1: Shape \"plymesh\" needs \"string filename\""},
            {"\"plymesh\" \"string filename\" \"none.ply\"", ":2:17: none.ply: there is no such file"},
            {"\"plymesh\" \"string filename\" \"/\"", ":2:17: /: is not a regular file"},
        },
        "WorldBegin\nShape ");
}

TEST(SceneErrors, motion) {
    check({
        {"TransformTimes 1 0.5 WorldBegin", ":1:1: TransformTimes needs a start before the end"},
        {"TransformTimes 0 inf WorldBegin", ":1:18: 'inf' is not a finite number in the range of a float"},
        {"ActiveTransform EndTime Scale 0 1 1\nCamera \"perspective\" WorldBegin",
         ":2:1: the transform here is singular: it cannot be inverted"},
        {"WorldBegin\nActiveTransform EndTime\nScale -1 1 1\nShape \"sphere\"",
         ":4:1: the transform here mirrors at one of StartTime and EndTime, but not at the other: it would "
         "be singular in between"},

    });
}

TEST(SceneErrors, options) {
    check({
        {"Film \"rbg\"\nWorldBegin", ":1:1: film \"rbg\" is not supported, did you mean 'rgb'?"},
        {"Film \"rgb\" \"integer xresolution\" 0 WorldBegin",
         ":1:12: 'xresolution' is 0, but must be at least 1 and at most 1048576"},
        {"Film \"rgb\" \"integer xresolution\" 1000000 \"integer yresolution\" 1000000 WorldBegin",
         ":1:1: 1000000x1000000 pixels are more than the limit of 268435456"},
        {"Film \"rgb\" \"float cropwindow\" [0 1 0] WorldBegin",
         ":1:12: 'cropwindow' needs four numbers: x0, x1, y0, y1"},
        {"Film \"rgb\" \"float cropwindow\" [.5 .5 0 1] WorldBegin",
         ":1:1: the crop leaves no pixel of the film"},
        {"Film \"rgb\" \"string sensor\" \"canon_eos_5dd\" WorldBegin",
         ":1:12: unknown sensor \"canon_eos_5dd\", did you mean 'canon_eos_5d'?"},
        {"Film \"rgb\" \"float whitebalance\" 100 WorldBegin",
         ":1:12: 'whitebalance' is 100, but must be 0 or at least 500"},
        {"PixelFilter \"gausian\" WorldBegin",
         ":1:1: pixel filter \"gausian\" is not supported, did you mean 'gaussian'?"},
        {"PixelFilter \"box\" \"float xradius\" 0 WorldBegin",
         ":1:19: 'xradius' is 0, but must be above 0 and at most 128"},
        {"PixelFilter \"box\" \"float sigma\" 1 WorldBegin",
         ":1:19: PixelFilter \"box\" has no parameter 'sigma', or none that is supported"},
        {"Sampler \"sobel\" WorldBegin", ":1:1: sampler \"sobel\" is not supported, did you mean 'sobol'?"},
        {"Sampler \"sobol\" \"integer pixelsamples\" 1000000000 WorldBegin",
         ":1:17: 'pixelsamples' is 1000000000, but must be at least 1 and at most 1048576"},
        {"Integrator \"bdtp\" WorldBegin",
         ":1:1: integrator \"bdtp\" is not supported, did you mean 'bdpt'?"},

        {"Integrator \"path\" \"integer maxdpth\" 1 WorldBegin",
         ":1:19: Integrator \"path\" has no parameter 'maxdpth', or none that is supported, did you mean "
         "'maxdepth'?"},
        {"Camera \"perspective\" \"float fov\" 180 WorldBegin",
         ":1:22: 'fov' is 180, but must be above 0 and at most 179.99"},
        {"Camera \"perspective\" \"float lensradius\" -1 WorldBegin",
         ":1:22: 'lensradius' is -1, but must be at least 0"},
        {"Camera \"perspective\" \"float shutteropen\" 2 WorldBegin",
         ":1:1: the shutter closes before it opens: 'shutterclose' must be after 'shutteropen'"},
        {"Camera \"perspective\" \"string aperture\" \"pentagram\" WorldBegin",
         ":1:22: aperture \"pentagram\" is not one of disc, gaussian, square, pentagon, star, polygon, nor "
         "an "
         "image file, did you mean 'pentagon'?"},
        {"Camera \"perspective\" \"string aperture\" \"polygon 2\" WorldBegin",
         ":1:22: aperture \"polygon 2\" is not \"polygon BLADES\" or \"polygon BLADES DEGREES\" with 3 to "
         "100 blades and at most 360 degrees"},
        {"Camera \"perspective\" \"string aperture\" \"polygon\" WorldBegin",
         ":1:22: aperture \"polygon\" is not \"polygon BLADES\" or \"polygon BLADES DEGREES\" with 3 to "
         "100 blades and at most 360 degrees"},
        {"Camera \"perspective\" \"string aperture\" \"image 12\" WorldBegin",
         ":1:22: aperture \"image 12\" is not one of disc, gaussian, square, pentagon, star, polygon, nor an "
         "image file"},
        {"Camera \"perspective\" \"float focaldist\" 1 WorldBegin",
         ":1:22: Camera \"perspective\" has no parameter 'focaldist', or none that is supported"},
    });
}

TEST(SceneErrors, materialsAndTextures) {
    check(
        {
            {"Material \"difuse\"", ":2:1: material \"difuse\" is not supported, did you mean 'diffuse'?"},
            {"Material \"varnish\"", ":2:1: material \"varnish\" is not supported"},
            {"Material \"hair\"", ":2:1: material \"hair\" is not supported: a sample has one depth, and "
                                  "strands thinner than a pixel have many"},
            {"Material \"diffuse\" \"rgb reflectance\" [1 1 2]",
             ":2:20: 'reflectance' is 2, but must be at least 0 and at most 1"},
            {"Material \"diffuse\" \"rgb reflectance\" [1 1 1 1 1 1]",
             ":2:20: rgb 'reflectance' must have three values"},
            {"Material \"diffuse\" \"float reflectance\" 1",
             ":2:20: 'reflectance' of Material \"diffuse\" is given as float, but must be rgb, spectrum, "
             "blackbody, texture"},
            {"Material \"diffuse\" \"spectrum reflectance\" [400 .1 400 .2]",
             ":2:20: 'reflectance': wavelengths must ascend, but 400 follows 400"},
            {"Material \"diffuse\" \"spectrum reflectance\" \"none.spd\"",
             ":2:20: none.spd: there is no such file"},
            {"Material \"conductor\" \"spectrum eta\" \"metal-Cu-ete\"",
             ":2:22: 'eta': spectrum \"metal-Cu-ete\" is not supported here; give \"rgb eta\", did you mean "
             "'metal-Cu-eta'?"},
            {"Material \"conductor\" \"rgb reflectance\" [1 1 1] \"rgb k\" [1 1 1]",
             ":2:48: a conductor has either 'reflectance' or 'eta' and 'k'"},
            {"Material \"diffuse\" \"blackbody reflectance\" 3000",
             ":2:20: blackbody 'reflectance' must be one temperature of a light"},
            {"Material \"coateddiffuse\" \"spectrum eta\" \"glass-BK8\"",
             ":2:26: 'eta': unknown glass \"glass-BK8\"; give \"float eta\", did you mean 'glass-BK7'?"},
            {"Material \"diffuse\" \"texture displacement\" \"x\"", ":2:20: there is no float texture 'x'"},
            {"Material \"mix\" \"string materials\" [\"a\"]",
             ":2:16: Material \"mix\" needs two names: \"string materials\""},
            {"MakeNamedMaterial \"a\" \"string type\" \"diffuse\" Material \"mix\" \"string materials\" "
             "[\"a\" \"b\"]",
             ":2:62: there is no material 'b'"},
            {"MakeNamedMaterial \"a\" \"string type\" \"mix\" \"string materials\" [\"a\" \"a\"]",
             ":2:1: this material is a mix of itself, or nested more than 32 deep"},
            {"MakeNamedMaterial \"a\" \"string type\" \"interface\"\nMaterial \"mix\" \"string materials\" "
             "[\"a\" \"a\"]",
             ":3:1: an \"interface\" cannot be part of a mix"},
            {"Material \"dielectric\" \"float eta\" 0", ":2:23: 'eta' is 0, but must be above 0"},
            {"Material \"diffuse\" \"texture reflectance\" \"chekcs\"\nTexture \"checks\" \"spectrum\" "
             "\"constant\"",
             ":2:20: there is no spectrum texture 'chekcs', did you mean 'checks'?"},
            {"Texture \"a\" \"float\" \"constant\"\nMaterial \"diffuse\" \"texture reflectance\" \"a\"",
             ":3:20: 'reflectance' needs a spectrum texture, but 'a' is a float texture"},
            {"NamedMaterial \"gold\" MakeNamedMaterial \"golden\" \"string type\" \"conductor\"",
             ":2:1: there is no material 'gold'"},
            {"NamedMaterial \"goldn\" MakeNamedMaterial \"golden\" \"string type\" \"conductor\"",
             ":2:1: there is no material 'goldn', did you mean 'golden'?"},
            {"MakeNamedMaterial \"a\"", ":2:1: MakeNamedMaterial \"a\" needs \"string type\""},
            {"MakeNamedMaterial \"a\" \"string type\" \"diffuse\" MakeNamedMaterial \"a\" \"string type\" "
             "\"diffuse\"",
             ":2:47: the material 'a' is made twice"},
            {"Texture \"a\" \"floot\" \"constant\"", ":2:13: the type of a texture is \"float\" or "
                                                     "\"spectrum\", not \"floot\", did you mean 'float'?"},
            {"Texture \"a\" \"float\" \"constant\" Texture \"a\" \"float\" \"mix\"",
             ":2:32: the float texture 'a' is defined twice"},
            {"Texture \"a\" \"float\" \"marbel\"",
             ":2:1: texture kind \"marbel\" is not supported, did you mean 'marble'?"},
            {"Texture \"a\" \"float\" \"fbm\" \"integer octaves\" 100",
             ":2:27: 'octaves' is 100, but must be at least 0 and at most 32"},
            {"Texture \"a\" \"float\" \"scale\" \"texture tex\" \"a\"",
             ":2:1: this texture is made of itself"},
            {"Texture \"a\" \"float\" \"checkerboard\" \"integer dimension\" 4",
             ":2:36: 'dimension' is 4, but must be at least 2 and at most 3"},
            {"Texture \"a\" \"float\" \"directionmix\" \"vector3 dir\" [0 0 0]",
             ":2:36: 'dir' must not be 0 0 0"},
            {"Texture \"a\" \"float\" \"checkerboard\" \"string mapping\" \"cubic\"",
             ":2:36: 'mapping' is \"cubic\", but must be one of: uv, planar, spherical, cylindrical"},
            {"Texture \"a\" \"float\" \"constant\" \"float vlue\" 1",
             ":2:32: Texture \"a\" has no parameter 'vlue', or none that is supported, did you mean "
             "'value'?"},
            {"Texture \"a\" \"float\" \"imagemap\"", ":2:1: Texture \"a\" needs \"string filename\""},
            {"Texture \"a\" \"float\" \"imagemap\" \"string filename\" \"none.png\"",
             ":2:32: none.png: there is no such file"},
            {"Texture \"a\" \"float\" \"imagemap\" \"string filename\" \"x\" \"string encoding\" \"rec709\"",
             ":2:54: 'encoding' is \"rec709\", but must be \"sRGB\", \"linear\" or \"gamma N\""},
        },
        "WorldBegin\n");
    std::string deep = "WorldBegin Texture \"t200\" \"float\" \"constant\"\n";
    for (int i = 0; i < 200; ++i)
        deep += fmt::format("Texture \"t{}\" \"float\" \"scale\" \"texture tex\" \"t{}\"\n", i, i + 1);
    EXPECT_THAT(errorOf(deep), HasSubstr("textures are nested more than 100 deep"));
}

TEST(SceneErrors, lights) {
    check(
        {
            {"LightSource \"laser\"", ":2:1: light \"laser\" is not supported"},
            {"LightSource \"pointt\"", ":2:1: light \"pointt\" is not supported, did you mean 'point'?"},
            {"LightSource \"point\" \"rgb L\" [1 1 1]",
             ":2:21: LightSource \"point\" has no parameter 'L', or none that is supported"},
            {"LightSource \"point\" \"rgb I\" [1 -1 1]", ":2:21: 'I' is -1, but must be at least 0"},
            {"LightSource \"distant\" \"point3 to\" [0 0 0]",
             ":2:1: a distant light needs 'from' and 'to' apart"},
            {"LightSource \"infinite\" \"blackbody L\" 10",
             ":2:24: 'L' is 10, but must be at least 500 and at most 1000000"},
            {"LightSource \"infinite\" \"spectrum L\" \"stdillum-D75\"",
             ":2:24: 'L': spectrum \"stdillum-D75\" is not supported here; give \"rgb L\", did you mean "
             "'stdillum-D65'?"},
            {"LightSource \"infinite\" \"point3 portal\" [0 0 0]",
             ":2:24: 'portal' needs four corners, not 1"},
            {"LightSource \"infinite\" \"rgb L\" [1 1 1] \"string filename\" \"a.exr\"",
             ":2:24: an infinite light has either 'L' or 'filename'"},
            {"AreaLightSource \"difuse\"",
             ":2:1: area light \"difuse\" is not supported, did you mean 'diffuse'?"},
            {"AreaLightSource \"diffuse\" \"string filename\" \"a.exr\" \"rgb L\" [1 1 1]",
             ":2:53: an area light has either 'L' or 'filename'"},
            {"LightSource \"spot\" \"point3 to\" [0 0 0]", ":2:1: a spot light needs 'from' and 'to' apart"},
            {"LightSource \"projection\"", ":2:1: LightSource \"projection\" needs \"string filename\""},
        },
        "WorldBegin\n");
}

TEST(SceneErrors, olderFiles) {
    check(
        {
            {"Material \"uber\" \"color opacity\" [.5 .5 .5]",
             ":2:17: an 'opacity' other than 1 of material \"uber\" is not supported"},
            {"Material \"mix\" \"string namedmaterial1\" \"a\"",
             ":2:1: Material \"mix\" needs \"string namedmaterial2\""},
            {"LightSource \"point\" \"color scale\" [1 2 1]",
             ":2:21: a 'scale' that is not grey is not supported here"},
            {"Shape \"trianglemesh\" \"point P\" [0 0 0 1 0 0 0 1 0] \"float st\" [0 0 1]",
             ":2:52: 'uv' has 3 numbers, not a multiple of 2"},
            {"Volume \"homogeneous\"", ":2:1: participating media are not supported"},
        },
        "WorldBegin\n");
}

} // namespace
} // namespace slant
