// Lights that move: as bright as the mean of the still lights that they are over the shutter.
#include "scene/transforms.h"
#include "trace/tracer.h"
#include "unit/trace_scenes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace slant {
namespace {

using testing::emptyScene;
using testing::meshShape;
using testing::sphereShape;
using testing::still;

const glm::dmat4 kOne(1);

enum class Kind { sphere, stretchedSphere, disk, triangles, flatPatch, bentPatch };

/// A floor under a light that the camera does not see.
Scene litScene(Kind kind, const Material& material) {
    Scene scene = emptyScene(16, 12);
    scene.lights.clear();
    scene.maxDepth = 1;
    scene.materials[0] = material;
    scene.areaLights.emplace_back();
    Mesh floor;
    floor.kind = Mesh::Kind::bilinearPatches;
    floor.positions = {{-4, -1, 1}, {4, -1, 1}, {-4, -1, 9}, {4, -1, 9}};
    floor.indices = {0, 1, 2, 3};
    scene.shapes.push_back(meshShape(scene, floor));
    Shape light = sphereShape(0.5f, kOne);
    if (kind == Kind::disk) light.kind = ShapeKind::disk;
    Mesh mesh;
    mesh.positions = {{-0.7f, 0, -0.5f}, {0.7f, 0, -0.5f}, {-0.7f, 0, 0.5f}, {0.7f, 0, 0.5f}};
    if (kind == Kind::bentPatch) mesh.positions[3].y = 0.6f;
    mesh.kind = kind == Kind::triangles ? Mesh::Kind::triangles : Mesh::Kind::bilinearPatches;
    mesh.indices = {0, 1, 2, 3};
    if (kind == Kind::triangles) mesh.indices = {0, 1, 2, 1, 3, 2};
    if (kind > Kind::disk) light = meshShape(scene, mesh);
    light.areaLightIndex = 0;
    scene.areaLights[0].twoSided = kind == Kind::disk;
    scene.shapes.push_back(light);
    return scene;
}

double meanOf(const Scene& scene, int spp, std::uint64_t seed) {
    SilentMonitor monitor;
    const Tracer tracer(scene, monitor);
    SampleSet set;
    set.resize(scene.film.crop.area() * std::size_t(spp), {});
    tracer.trace(scene.film.crop, {0, spp}, spp, seed, spansOf(set), monitor);
    double sum = 0;
    for (const glm::vec3& rgb : set.radiance) sum += double(rgb.g);
    return sum / double(set.radiance.size());
}

TEST(MovingLights, areAsBrightAsTheMeanOfStillOnes) {
    Material diffuse;
    diffuse.reflectance = 0;
    for (const Kind kind :
         {Kind::sphere, Kind::stretchedSphere, Kind::disk, Kind::triangles, Kind::flatPatch, Kind::bentPatch})
        for (const bool glossy : {false, true}) {
            Scene scene = litScene(kind, diffuse);
            if (glossy) {
                Texture roughness;
                roughness.value = glm::vec3(0.3f);
                scene.textures.push_back(roughness);
                Material& material = scene.materials[0];
                material.kind = MaterialKind::conductor;
                material.uRoughness = material.vRoughness = int(scene.textures.size()) - 1;
            }
            glm::dmat4 shape = kOne;
            if (kind == Kind::stretchedSphere) shape = glm::scale(kOne, glm::dvec3(1, 0.5, 1.4));
            Shape& light = scene.shapes[1];
            light.worldFromObject = {
                {glm::translate(kOne, glm::dvec3(-1.5, 2.5, 3)) * shape,
                 glm::translate(kOne, glm::dvec3(1.2, 3.6, 5)) * rotation(70, {0, 0.3, 1}) * shape}};
            const AnimatedTransform motion(light.worldFromObject);
            const double ours = meanOf(scene, 512, 1);
            constexpr int kTimes = 32;
            double truth = 0;
            for (int i = 0; i < kTimes; ++i) {
                light.worldFromObject = still(motion.at((i + 0.5) / kTimes));
                truth += meanOf(scene, 64, std::uint64_t(i)) / kTimes;
            }
            EXPECT_GT(truth, 1e-4) << int(kind);
            EXPECT_NEAR(ours, truth, 0.03 * truth) << int(kind) << " " << glossy;
        }
}

TEST(MovingLights, areSampledWhereTheyAre) {
    // Without that, only rays that scatter by chance would meet it, and most samples of the floor be black.
    Material diffuse;
    diffuse.reflectance = 0;
    Scene scene = litScene(Kind::sphere, diffuse);
    scene.shapes[1].worldFromObject = {
        {glm::translate(kOne, glm::dvec3(-1.5, 1, 3)), glm::translate(kOne, glm::dvec3(1.5, 1, 3))}};
    SilentMonitor monitor;
    const Tracer tracer(scene, monitor);
    SampleSet set;
    const Rect floor{4, 9, 12, 12};
    set.resize(floor.area() * 16, {});
    tracer.trace(floor, {0, 16}, 16, 3, spansOf(set), monitor);
    for (const glm::vec3& rgb : set.radiance) EXPECT_GT(rgb.g, 0);
}

/// A patch with two equal corners is a triangle, and the other half is nothing.
TEST(MovingLights, knowTheHalfOfAPatchThatWasHit) {
    Material diffuse;
    diffuse.reflectance = 0;
    Scene scene = litScene(Kind::flatPatch, diffuse);
    Mesh& mesh = scene.meshes[1];
    mesh.positions[0] = mesh.positions[2];
    Shape& light = scene.shapes[1];
    light.worldFromObject = {
        {glm::translate(kOne, glm::dvec3(0, 2.5, 3)), glm::translate(kOne, glm::dvec3(0, 3.6, 5))}};
    const AnimatedTransform motion(light.worldFromObject);
    const double ours = meanOf(scene, 512, 1);
    double truth = 0;
    for (int i = 0; i < 16; ++i) {
        light.worldFromObject = still(motion.at((i + 0.5) / 16));
        truth += meanOf(scene, 64, std::uint64_t(i)) / 16;
    }
    EXPECT_NEAR(ours, truth, 0.03 * truth);
}

} // namespace
} // namespace slant
