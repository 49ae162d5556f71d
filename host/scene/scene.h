// A scene as plain data: what a pbrt-v4 file of the supported subset says, resolved (includes read, meshes
// and images loaded, named things turned into indices, defaults filled in, transforms composed), with pbrt's
// meaning and units. No Embree, no shading here.
//
// Conventions are pbrt's: left-handed world, camera looks along +z, transforms act on column vectors,
// colours are linear Rec.709 RGB. Every `...Index` refers into the vector of that name in Scene; -1 = none.
#pragma once
#include "base/error.h"
#include "base/rect.h"
#include "image/image.h"
#include "scene/aperture_shape.h"

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace slant {

/// A transform at two times of the shutter, which opens at 0 and closes at 1; between and beyond them it is
/// what AnimatedTransform says. Equal matrices where nothing moves while the shutter is open.
struct MovingTransform {
    std::array<glm::dmat4, 2> at{glm::dmat4(1.0), glm::dmat4(1.0)};
    std::array<double, 2> times{0, 1};
    bool moves() const { return at[0] != at[1]; }
};

// ---------------------------------------------------------------- film, filter, camera

enum class FilterKind { box, triangle, gaussian, mitchell, sinc };

/// pbrt-v4 PixelFilter; radii in pixels. The filter is separable: f(x) f(y).
struct PixelFilter {
    FilterKind kind = FilterKind::gaussian;
    glm::vec2 radius{1.5f, 1.5f};
    float sigma = 0.5f;             ///< gaussian
    float b = 1.f / 3, c = 1.f / 3; ///< mitchell
    float tau = 3;                  ///< sinc (Lanczos-windowed)
};

/// Film "rgb". Radiance is multiplied by `imagingRatio` (pbrt's exposure, iso) and by `whiteBalance`.
struct Film {
    int xResolution = 1280, yResolution = 720;
    Rect crop{0, 0, 1280, 720}; ///< pixels to render, inside the resolution
    std::string filename = "pbrt.exr";
    float imagingRatio = 1;
    glm::mat3 whiteBalance{1};
    float maxComponentValue = 0; ///< samples are scaled down to it; 0 = no limit
    float diagonalMm = 35;       ///< for realistic cameras
};

/// Cameras "perspective", "orthographic" (parallel), and "spherical" with either mapping.
enum class Projection { perspective, parallel, equalArea, equirectangular };

/// All cameras but "realistic".
struct PerspectiveCamera {
    Projection projection = Projection::perspective;
    MovingTransform worldFromCamera;
    float fovDegrees = 90;      ///< of the shorter axis
    float lensRadius = 0;       ///< world units; 0 = pinhole
    float focalDistance = 1e6f; ///< distance along z of the plane in focus
    ApertureShape aperture;
    glm::vec2 screenMin{-1, -1}, screenMax{1, 1}; ///< screen window after frameaspectratio and its default
    float shutterOpen = 0, shutterClose = 1;
};

/// One surface of a lens; millimetres.
struct LensSurface {
    double radius; ///< of curvature, positive if the centre lies towards the film; 0: the plane of the stop
    double thickness; ///< distance on the axis to the next surface, towards the film
    double index;     ///< of refraction between it and the next one
    double diameter;  ///< clear
    int line = 0;     ///< of the file
};

/// A lens from front (scene) to rear (film), valid as scene/lens_file.h says.
struct LensPrescription {
    std::string path; ///< for messages
    std::vector<LensSurface> surfaces;
    std::size_t stop = 0; ///< index of the aperture stop
};

/// Camera "realistic": a lens in front of the film, which is the plane z = 0 of camera space, in metres.
struct RealisticCamera {
    LensPrescription lens;
    double apertureDiameterMm = 1;          ///< of the stop, at most what the lens has
    double focusDistance = 10;              ///< of the plane in focus, from the film, in metres
    FileLocation focusLocation;             ///< for errors
    ApertureShape aperture;                 ///< of the stop
    std::optional<double> filmDistanceMm{}; ///< of the film from the last surface, instead of the focus
};

// ---------------------------------------------------------------- textures, materials

enum class TextureKind {
    constant,
    scale,
    product, ///< of two colours; of older files only
    mix,
    directionMix,
    bilerp,
    checkerboard,
    dots,
    imagemap,
    fbm,
    wrinkled,
    windy,
    marble
};
/// To two coordinates, or (space) to three.
enum class TextureMapping { uv, planar, spherical, cylindrical, space };
enum class WrapMode { repeat, black, clamp, octahedralSphere };
enum class TexelFilter {
    point,
    bilinear
}; ///< trilinear and EWA are read as bilinear: no ray footprints here

/// One node of a texture graph. Float textures use .x of `value`. Children have a smaller index than their
/// parents, so evaluating a graph always ends.
struct Texture {
    TextureKind kind = TextureKind::constant;
    glm::vec3 value{1}; ///< constant
    /// scale, product: tex, scale; mix: tex1, tex2, amount; directionMix, checkerboard: tex1, tex2; dots:
    /// inside, outside; bilerp: v00, v01, v10, v11
    std::array<int, 4> child{-1, -1, -1, -1};
    TextureMapping mapping = TextureMapping::uv;
    glm::vec2 uvScale{1, 1}, uvDelta{0, 0};         ///< uv: st = uvScale * uv + uvDelta
    glm::dmat4 textureFromWorld{1.0};               ///< all but uv: applied to the world position first
    glm::vec3 planarV1{1, 0, 0}, planarV2{0, 1, 0}; ///< planar: st = (dot(p, v1), dot(p, v2)) + uvDelta
    int imageIndex = -1; ///< imagemap; texels are linear, colour encoding already undone
    WrapMode wrap = WrapMode::repeat;
    TexelFilter filter = TexelFilter::bilinear;
    float scale = 1;                          ///< imagemap; marble: of the position
    bool invert = false;                      ///< imagemap: value -> 1 - value
    int octaves = 8;                          ///< fbm, wrinkled, marble
    float roughness = 0.5f, variation = 0.2f; ///< fbm, wrinkled, marble; marble
    glm::vec3 direction{0, 1, 0};             ///< directionMix: unit, in the world
};

enum class MaterialKind {
    diffuse,
    coatedDiffuse,
    conductor,
    coatedConductor,
    dielectric,
    thinDielectric,
    diffuseTransmission,
    mix,
    interface ///< nothing at all; shapes of it are left out
};

/// Parameters are texture indices (constants are textures too), -1 for those that a kind does not have.
struct Material {
    MaterialKind kind = MaterialKind::diffuse;
    int reflectance = -1;                         ///< diffuse ones; conductor: instead of eta, k
    int transmittance = -1;                       ///< diffuseTransmission
    float scale = 1;                              ///< diffuseTransmission: of both
    int uRoughness = -1, vRoughness = -1;         ///< conductor, and of interfaces (float textures)
    int baseURoughness = -1, baseVRoughness = -1; ///< coatedConductor: of the metal
    bool remapRoughness = true;                   ///< alpha = sqrt(roughness)
    int eta = -1, k = -1;                         ///< metals: RGB index and absorption
    float interfaceEta = 1.5f;                    ///< of coats and dielectrics
    int thickness = -1;                           ///< of coats (float texture)
    float g = 0;                                  ///< of coats: medium asymmetry
    int albedo = -1;                              ///< of coats: medium albedo
    int maxDepth = 10, sampleCount = 1;           ///< of coats: pbrt's random-walk limits
    std::array<int, 2> mixed{-1, -1};             ///< mix: indices of materials; never in a circle
    int amount = -1;                              ///< mix: chance of the second one (float texture)
    int normalMapImage = -1;                      ///< all but mix: RGB, from 0 to 1; else
    int displacement = -1;                        ///< bumps (float texture), in units of the world
};

// ---------------------------------------------------------------- shapes

/// In object space. `normals`, `uvs` are empty or as many as `positions`.
struct Mesh {
    enum class Kind { triangles, bilinearPatches } kind = Kind::triangles;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<std::uint32_t> indices; ///< 3 per triangle; 4 per bilinear patch (p00, p10, p01, p11)
};

/// Cylinders and cones are hyperboloids whose line meets the axis or runs along it.
enum class ShapeKind { mesh, sphere, disk, hyperboloid, paraboloid };

/// One shape as the file has it. Meshes may be shared between shapes.
struct Shape {
    ShapeKind kind = ShapeKind::mesh;
    int meshIndex = -1;
    float radius = 1;                  ///< sphere, disk
    float zMin = -1, zMax = 1;         ///< sphere
    float height = 0, innerRadius = 0; ///< disk
    std::array<glm::vec3, 2>
        ends{};                ///< hyperboloid: of the line that turns about z; paraboloid: of the curve
    float phiMaxDegrees = 360; ///< all but meshes
    MovingTransform worldFromObject; ///< inside an object definition: instance space from object space
    bool reverseOrientation = false;
    int materialIndex = -1; ///< never -1 after parsing
    int areaLightIndex = -1;
    int alpha = -1;        ///< share of rays that it stops (float texture); -1: all
    FileLocation location; ///< for late errors
};

/// ObjectBegin ... ObjectEnd. Emission inside is dropped, as in pbrt, with a warning at parse time.
struct ObjectDefinition {
    std::string name;
    std::vector<Shape> shapes;
};

struct ObjectInstance {
    int objectIndex = -1;
    MovingTransform worldFromInstance;
};

// ---------------------------------------------------------------- lights

/// AreaLightSource "diffuse". Emitted radiance is `radiance` * `scale`; if `power` (W) is set, also divided
/// by the power that radiance 1 gives and times `power`. pbrt does so for each sphere, disk, triangle and
/// patch on its own: a mesh of n faces emits n times `power`.
struct AreaLight {
    glm::vec3 radiance{1};
    float scale = 1;
    bool twoSided = false;
    std::optional<float> power;
    int imageIndex = -1; ///< RGB, over the shape's u and v, in place of `radiance`; -1: none
};

enum class LightKind { point, spot, goniometric, projection, distant, infinite };

struct Light {
    LightKind kind = LightKind::point;
    glm::vec3 emission{1}; ///< those with a place: intensity I; distant, infinite: radiance L
    float scale = 1;
    std::optional<float> power;       ///< those with a place: W
    std::optional<float> illuminance; ///< distant, infinite: lux on a surface facing it
    glm::dmat4 worldFromLight{1.0};
    glm::vec3 from{0, 0, 0},
        to{0, 0, 1}; ///< light space; point uses from, distant and spot shine from `from` to `to`
    float coneDegrees = 30, coneDeltaDegrees = 5; ///< spot: half its angle, and the part of it that fades
    float fovDegrees = 90;                        ///< projection: of the shorter axis
    int imageIndex = -1; ///< infinite, goniometric: equal-area octahedral square image; -1: constant
    std::optional<std::array<glm::vec3, 4>> portal; ///< infinite: corners of its opening, world space
    FileLocation location;
};

// ---------------------------------------------------------------- the whole

struct Scene {
    std::string path;               ///< the file it was read from
    std::vector<std::string> files; ///< all that were read for it: that one, includes, meshes, images
    Film film;
    PixelFilter filter;
    PerspectiveCamera camera;
    std::optional<RealisticCamera> realistic; ///< if set: of `camera` only transform and shutter count
    int pixelSamples = 16;                    ///< Sampler "pixelsamples"
    int maxDepth = 5;                         ///< Integrator "path": number of bounces
    std::vector<Image> images;                ///< 1 or 3 channels
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Shape> shapes;
    std::vector<ObjectDefinition> objects;
    std::vector<ObjectInstance> instances;
    std::vector<AreaLight> areaLights;
    std::vector<Light> lights;
};

} // namespace slant
