// Brightness through real lenses stays that of brute force, in the middle and in the corners of the film,
// however few the samples and whatever the shape of the stop.
#include "reconstruct/cpu_reconstructor.h"
#include "render/brute_force.h"
#include "support/lenses.h"
#include "trace/sample_pass.h"
#include "unit/trace_scenes.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

constexpr int kWidth = 64, kHeight = 36;

struct Case {
    const char* lens;
    double focusDistance; ///< metres
    float diagonalMm;
    const char* aperture;
};

/// An emitting rectangle across the axis.
void addRectangle(Scene& scene, glm::dvec3 centre, glm::dvec2 half, float radiance) {
    Mesh mesh;
    mesh.kind = Mesh::Kind::bilinearPatches;
    for (const double y : {-1.0, 1.0})
        for (const double x : {-1.0, 1.0})
            mesh.positions.emplace_back(centre + glm::dvec3(half * glm::dvec2(x, y), 0));
    mesh.indices = {0, 1, 2, 3};
    Shape shape = testing::meshShape(scene, std::move(mesh));
    shape.areaLightIndex = int(scene.areaLights.size());
    scene.areaLights.emplace_back().radiance = glm::vec3(radiance);
    scene.areaLights.back().twoSided = true;
    scene.shapes.push_back(shape);
}

/// A plane out of focus with strips in front of it, in focus and nearer, in greys that differ little: so
/// there is no noise from shading, and little from where samples happen to lie.
Scene sceneOf(const Case& c) {
    Scene scene = testing::emptyScene(kWidth, kHeight);
    scene.film.diagonalMm = c.diagonalMm;
    scene.realistic.emplace();
    scene.realistic->lens = test::lensNamed(c.lens);
    scene.realistic->apertureDiameterMm = scene.realistic->lens.surfaces[scene.realistic->lens.stop].diameter;
    scene.realistic->focusDistance = c.focusDistance;
    scene.realistic->aperture = parseAperture(c.aperture, {}).value();
    scene.lights.clear();
    scene.textures[0].value = glm::vec3(0); // surfaces emit and reflect nothing
    const double f = c.focusDistance, wide = f / 40 * (c.focusDistance < 0.5 ? 4 : 1), all = 40 * f;
    addRectangle(scene, {0, 0, 2 * f}, glm::dvec2(all), 1);
    for (int i = -3; i <= 3; ++i) {
        addRectangle(scene, {5 * wide * i, 0, f}, {wide, all}, 1.2f);
        addRectangle(scene, {0, (3 * i + 1) * wide, 0.7 * f}, {all, 0.5 * wide}, 0.8f);
    }
    return scene;
}

/// Means of the middle and of the four corners.
struct Means {
    double middle = 0, corners = 0;
};
Means meansOf(const Image& image) {
    double middle = 0, corners = 0;
    int inMiddle = 0, inCorners = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const double px = std::abs(x - (kWidth - 1) / 2.0), py = std::abs(y - (kHeight - 1) / 2.0);
            if (px < 14 && py < 9) middle += double(image.at(x, y, 1)), ++inMiddle;
            if (px > 19 && py > 10) corners += double(image.at(x, y, 1)), ++inCorners;
        }
    return {middle / inMiddle, corners / inCorners};
}

class LensBrightness : public ::testing::TestWithParam<Case> {};

TEST_P(LensBrightness, isThatOfBruteForceFromOneSampleTo64) {
    Scene scene = sceneOf(GetParam());
    scene.pixelSamples = 144;
    SilentMonitor monitor;
    const Tracer tracer(scene, monitor);
    const Means truth = meansOf(bruteForce(scene, tracer, 99, monitor).image);
    EXPECT_GT(truth.middle, 1.02 * truth.corners);
    for (const auto& [spp, seeds] : {std::pair(1, 12), {4, 4}, {8, 2}, {16, 1}, {64, 1}}) {
        Means sum;
        for (int seed = 0; seed < seeds; ++seed) {
            LightField field = traceLightField(
                tracer, scene, {.samplesPerPixel = spp, .seed = std::uint64_t(seed)}, monitor);
            sanitize(field);
            ReconstructOptions options;
            options.outputsPerPixel = 16;
            options.filter = scene.filter;
            options.seed = std::uint64_t(seed);
            ReconstructReport report;
            const Means means =
                meansOf(CpuReconstructor().reconstruct(field, options, monitor, report, nullptr));
            EXPECT_EQ(report.emptyPixels, 0u);
            sum.middle += means.middle / seeds;
            sum.corners += means.corners / seeds;
        }
        EXPECT_NEAR(sum.middle / truth.middle, 1, 0.005) << spp;
        EXPECT_NEAR(sum.corners / truth.corners, 1, 0.005) << spp;
    }
}

std::string nameOf(const ::testing::TestParamInfo<Case>& info) {
    const std::string lens = info.param.lens, shape = info.param.aperture;
    return lens.substr(0, lens.find('-')) + "_" + shape.substr(0, shape.find(' '));
}

INSTANTIATE_TEST_SUITE_P(
    Lenses, LensBrightness,
    ::testing::Values(Case{"dgauss-50mm", 1, 35, "disc"}, Case{"wide-22mm", 0.6, 32, "disc"},
                      Case{"telephoto-250mm", 4, 35, "disc"}, Case{"fisheye-10mm", 0.4, 20, "disc"},
                      Case{"dgauss-50mm", 1, 35, "star"}, Case{"fisheye-10mm", 0.4, 20, "polygon 5"}),
    nameOf);

} // namespace
} // namespace slant
