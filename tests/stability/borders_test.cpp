// The border of a picture under wide pixel filters and heavy blur: as close to brute force as the same pixels
// are inside a larger picture.
#include "render/brute_force.h"
#include "render/render.h"
#include "support/synthetic.h"
#include "trace/sample_pass.h"
#include "unit/trace_scenes.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace slant {
namespace {

constexpr int kWidth = 72, kHeight = 60, kRimPx = 4;
const Rect kCrop{20, 18, 50, 40};

/// Emitting squares side by side, with random greys and sizes, across the whole view and beyond it.
void addSquares(Scene& scene, double z, double pitch, double cover, std::uint32_t seed) {
    synthetic::Random random(seed);
    for (int y = -12; y <= 12; ++y)
        for (int x = -12; x <= 12; ++x) {
            const float grey = 0.1f + 0.9f * random.uniform();
            if (random.uniform() > float(cover)) continue;
            Mesh mesh;
            mesh.kind = Mesh::Kind::bilinearPatches;
            for (const double b : {0.0, 1.0})
                for (const double a : {0.0, 1.0})
                    mesh.positions.emplace_back(pitch * (x + a), pitch * (y + b), z);
            mesh.indices = {0, 1, 2, 3};
            Shape shape = testing::meshShape(scene, std::move(mesh));
            shape.areaLightIndex = int(scene.areaLights.size());
            scene.areaLights.emplace_back().radiance = glm::vec3(grey);
            scene.areaLights.back().twoSided = true;
            scene.shapes.push_back(std::move(shape));
        }
}

/// Blur of up to 11 pixels to each side, in front of the focus and behind it.
Scene sceneOf(const PixelFilter& filter, float lensRadius) {
    Scene scene = testing::emptyScene(kWidth, kHeight);
    scene.lights.clear();
    scene.textures[0].value = glm::vec3(0); // surfaces emit and reflect nothing
    scene.filter = filter;
    scene.camera.lensRadius = lensRadius;
    scene.camera.focalDistance = 6;
    addSquares(scene, 9, 0.8, 1.1, 1);
    addSquares(scene, 4, 0.4, 0.3, 2);
    return scene;
}

/// Mean squared error of the outermost pixels of the crop.
double rimError(const Image& image, const Image& truth) {
    double sum = 0;
    int count = 0;
    for (int y = kCrop.y0; y < kCrop.y1; ++y)
        for (int x = kCrop.x0; x < kCrop.x1; ++x) {
            if (std::min({x - kCrop.x0, y - kCrop.y0, kCrop.x1 - 1 - x, kCrop.y1 - 1 - y}) >= kRimPx)
                continue;
            const auto at = [&](const Image& each) {
                return double(each.at(x - each.dataWindow.x0, y - each.dataWindow.y0, 1));
            };
            sum += std::pow(at(image) - at(truth), 2.0);
            ++count;
        }
    return sum / count;
}

struct FilterCase {
    const char* name;
    PixelFilter filter;
};

void PrintTo(const FilterCase& filter, std::ostream* out) {
    *out << filter.name;
}

const FilterCase kFilters[] = {{"box", {FilterKind::box, {0.5f, 0.5f}}},
                               {"gaussian3", {FilterKind::gaussian, {3, 3}, 1}},
                               {"mitchell2", {FilterKind::mitchell, {2, 2}}},
                               {"sinc8", {FilterKind::sinc, {8, 8}, 0.5f, 1.f / 3, 1.f / 3, 3}}};

class Borders : public ::testing::TestWithParam<FilterCase> {};

TEST_P(Borders, areAsGoodAsTheInside) {
    for (const float lensRadius : {0.f, 0.8f}) {
        Scene whole = sceneOf(GetParam().filter, lensRadius), crop = whole;
        crop.film.crop = kCrop;
        SilentMonitor monitor;
        crop.pixelSamples = 400;
        const Image truth = bruteForce(crop, Tracer(crop, monitor), 99, monitor).image;
        Backend cpu("cpu");
        for (const Method method : {Method::full, Method::automatic}) {
            double atRim = 0, inside = 0;
            for (const std::uint64_t seed : {1, 2}) {
                RenderOptions options;
                options.sampling.samplesPerPixel = 4;
                options.sampling.seed = seed;
                options.reconstruction.method = method;
                options.reconstruction.outputsPerPixel = 32;
                atRim += rimError(render(crop, options, cpu, monitor).image, truth);
                inside += rimError(render(whole, options, cpu, monitor).image, truth);
            }
            EXPECT_LT(atRim, 1.15 * inside) << nameOf(method) << ", lens radius " << lensRadius;
        }
    }
}

/// `box` is brute force, at the borders too: also where no blur brings in what the filter sees.
TEST_P(Borders, ofPlainFilteringAreThoseOfBruteForce) {
    for (const float lensRadius : {0.f, 0.8f}) {
        Scene scene = sceneOf(GetParam().filter, lensRadius);
        scene.film.crop = kCrop;
        scene.pixelSamples = 3;
        SilentMonitor monitor;
        Backend cpu("cpu");
        RenderOptions options;
        options.sampling.samplesPerPixel = 3;
        options.sampling.seed = 5;
        options.reconstruction.method = Method::box;
        EXPECT_EQ(render(scene, options, cpu, monitor).image.pixels,
                  bruteForce(scene, Tracer(scene, monitor), 5, monitor).image.pixels)
            << lensRadius;
    }
}

INSTANTIATE_TEST_SUITE_P(Filters, Borders, ::testing::ValuesIn(kFilters),
                         [](const auto& filter) { return std::string(filter.param.name); });

} // namespace
} // namespace slant
