// Samples per second of the whole sample pass: pattern, camera, primary ray, shading, shadow ray, store. Run
// with one thread, so that items_per_second is that of one core.
#include "base/parallel.h"
#include "scene/read_scene.h"
#include "trace/pattern.h"
#include "trace/tracer.h"

#include <benchmark/benchmark.h>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace slant {
namespace {

constexpr const char* kHead = R"(
LookAt 0 2.2 -6  0 0.6 4  0 1 0
Camera "perspective" "float fov" 40 "float lensradius" 0.12 "float focaldistance" 9
Film "rgb" "integer xresolution" 480 "integer yresolution" 270
Integrator "path" "integer maxdepth" 1
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 40 38 34 ]
  Shape "bilinearmesh" "point3 P" [ -2 9 0  2 9 0  -2 9 4  2 9 4 ]
AttributeEnd
Texture "checks" "spectrum" "checkerboard" "float uscale" 40 "float vscale" 40
  "rgb tex1" [ .8 .7 .5 ] "rgb tex2" [ .2 .25 .3 ]
Texture "dots" "spectrum" "checkerboard" "float uscale" 16 "float vscale" 8
  "rgb tex1" [ .9 .3 .2 ] "rgb tex2" [ .9 .9 .8 ]
AttributeBegin
  Material "diffuse" "texture reflectance" "checks"
  Shape "bilinearmesh" "point3 P" [ -40 0 -10  40 0 -10  -40 0 70  40 0 70 ]
  Shape "bilinearmesh" "point3 P" [ -60 -1 60  60 -1 60  -60 40 60  60 40 60 ]
AttributeEnd
Material "diffuse" "texture reflectance" "dots"
)";

/// A hundred textured spheres on a floor.
Scene spheres() {
    std::string text = kHead;
    for (int i = 0; i < 100; ++i) {
        double z = 0.25 * i - 2, x = std::fmod(i * 0.618034, 1.0) * (4 + 0.4 * i) - (2 + 0.2 * i);
        text += fmt::format(
            "AttributeBegin\nTranslate {} 0.4 {}\nRotate {} 1 1 0\nShape \"sphere\" \"float radius\" "
            "0.4\nAttributeEnd\n",
            x, z, 37 * i);
    }
    SilentMonitor monitor;
    return readSceneText(text, "spheres", monitor);
}

/// A wavy ball of about `triangles` triangles.
Mesh wavyBall(int triangles) {
    Mesh mesh;
    const int rows = int(std::sqrt(triangles / 4.0)), columns = 2 * rows;
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j <= columns; ++j) {
            double theta = std::numbers::pi * i / rows, phi = 2 * std::numbers::pi * j / columns;
            double radius = 0.5 * (1 + 0.1 * std::sin(9 * theta) * std::cos(8 * phi));
            mesh.positions.emplace_back(radius * std::sin(theta) * std::cos(phi),
                                        radius * std::cos(theta) + 0.55,
                                        radius * std::sin(theta) * std::sin(phi));
            mesh.uvs.emplace_back(double(j) / columns, double(i) / rows);
        }
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            std::uint32_t a = std::uint32_t(i * (columns + 1) + j), b = a + std::uint32_t(columns) + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
    return mesh;
}

/// Eleven instances of a mesh of 100,000 triangles, receding.
Scene row() {
    SilentMonitor monitor;
    Scene scene = readSceneText(kHead, "row", monitor);
    scene.meshes.push_back(wavyBall(100000));
    Shape shape;
    shape.meshIndex = int(scene.meshes.size()) - 1;
    shape.materialIndex = scene.shapes.back().materialIndex;
    scene.objects.push_back({"ball", {shape}});
    for (int i = 0; i < 11; ++i) {
        ObjectInstance instance;
        instance.objectIndex = 0;
        instance.worldFromInstance.at.fill(glm::dmat4(1));
        for (glm::dmat4& m : instance.worldFromInstance.at) m[3] = glm::dvec4(0.6 * i - 2, 0, 1.5 * i - 3, 1);
        scene.instances.push_back(instance);
    }
    return scene;
}

void traceFrame(benchmark::State& state, const Scene& scene) {
    ThreadLimit one(1);
    SilentMonitor monitor;
    Tracer tracer(scene, monitor);
    const int spp = int(state.range(0));
    SampleSet set;
    set.resize(scene.film.crop.area() * std::size_t(spp), {});
    for (auto _ : state) tracer.trace(scene.film.crop, {0, spp}, spp, 1, spansOf(set), monitor);
    state.SetItemsProcessed(state.iterations() * std::int64_t(set.samples.size()));
}

void traceSpheres(benchmark::State& state) {
    traceFrame(state, spheres());
}
void traceRow(benchmark::State& state) {
    traceFrame(state, row());
}

void patternPoints(benchmark::State& state) {
    Pattern pattern(8, 1);
    int x = 0;
    for (auto _ : state) {
        PatternPixel pixel = pattern.pixel(++x, 5);
        for (int s = 0; s < 8; ++s) benchmark::DoNotOptimize(pattern.point(pixel, s));
    }
    state.SetItemsProcessed(state.iterations() * 8);
}

BENCHMARK(traceSpheres)->Arg(1)->Arg(8)->Unit(benchmark::kMillisecond);
BENCHMARK(traceRow)->Arg(1)->Arg(8)->Unit(benchmark::kMillisecond);
BENCHMARK(patternPoints);

} // namespace
} // namespace slant
