// The path integrator against known pictures and against a path tracer that never samples a light.
#include "shading_scene.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::average;
using test::Estimate;
using test::Random;

/// Triangles (of meshes and flat patches) and whole spheres of a scene, tested one after the other.
class BruteForce {
public:
    explicit BruteForce(const Scene& scene) {
        int light = 0;
        for (const Shape& shape : scene.shapes) {
            int emitter = shape.areaLightIndex >= 0 ? light++ : -1;
            glm::dmat4 m = shape.worldFromObject.at[0];
            if (shape.kind == ShapeKind::sphere) {
                spheres_.push_back(
                    {transformPoint(m, glm::vec3(0)), shape.radius, shape.materialIndex, {emitter, 0}});
                continue;
            }
            const Mesh& mesh = scene.meshes[std::size_t(shape.meshIndex)];
            int stride = mesh.kind == Mesh::Kind::triangles ? 3 : 4;
            auto p = [&](std::size_t i) { return transformPoint(m, mesh.positions[mesh.indices[i]]); };
            for (std::size_t i = 0; i < mesh.indices.size(); i += std::size_t(stride)) {
                EmitterId id{emitter, int(i) / stride};
                triangles_.push_back({p(i), p(i + 1), p(i + 2), shape.materialIndex, id});
                if (stride == 4)
                    triangles_.push_back({p(i + 3), p(i + 2), p(i + 1), shape.materialIndex, id});
            }
        }
    }
    bool intersect(const Ray& ray, SurfaceHit& hit) const {
        hit.t = ray.tMax;
        for (const Triangle& t : triangles_) {
            glm::vec3 e1 = t.b - t.a, e2 = t.c - t.a, n = glm::cross(e1, e2);
            float along = glm::dot(t.a - ray.origin, n) / glm::dot(ray.direction, n);
            if (!(along > 0 && along < hit.t)) continue;
            glm::vec3 p = ray.origin + along * ray.direction, q = p - t.a;
            float u = glm::dot(glm::cross(q, e2), n), v = glm::dot(glm::cross(e1, q), n),
                  all = glm::dot(n, n);
            if (u < 0 || v < 0 || u + v > all) continue;
            set(hit, along, p, glm::normalize(n), t.material, t.id);
        }
        for (const Sphere& s : spheres_) {
            glm::vec3 d = s.centre - ray.origin;
            float b = glm::dot(d, ray.direction), root = b * b - glm::dot(d, d) + s.radius * s.radius;
            if (root < 0) continue;
            for (float along : {b + std::sqrt(root), b - std::sqrt(root)})
                if (along > 1e-4f && along < hit.t) {
                    glm::vec3 p = ray.origin + along * ray.direction;
                    set(hit, along, p, glm::normalize(p - s.centre), s.material, s.id);
                }
        }
        return hit.hit();
    }
    bool occluded(const Ray& ray) const {
        SurfaceHit hit;
        return intersect(ray, hit);
    }

private:
    struct Triangle {
        glm::vec3 a, b, c;
        int material;
        EmitterId id;
    };
    struct Sphere {
        glm::vec3 centre;
        float radius;
        int material;
        EmitterId id;
    };
    static void set(SurfaceHit& hit, float t, glm::vec3 p, glm::vec3 n, int material, EmitterId id) {
        hit.t = t;
        hit.position = p;
        hit.geometricNormal = hit.shadingNormal = n;
        hit.dpdu = glm::vec3(1, 0.3f, 0);
        hit.positionError = 2e-6f * (glm::abs(p) + 1.f);
        hit.materialIndex = material;
        hit.emitter = id;
    }
    std::vector<Triangle> triangles_;
    std::vector<Sphere> spheres_;
};

/// Only scatters and counts the light it hits; it ignores lights that cannot be hit.
glm::vec3 naivePath(const BruteForce& geometry, const Shading& shading, Ray ray, int maxDepth,
                    Random& random) {
    glm::vec3 radiance(0), throughput(1);
    for (int depth = 0;; ++depth) {
        SurfaceHit hit;
        glm::vec3 wo = -ray.direction;
        if (!geometry.intersect(ray, hit)) {
            for (std::size_t i = 0; i < shading.lights.infiniteCount(); ++i)
                radiance += throughput * shading.lights.infiniteRadiance(i, ray.origin, ray.direction);
            return radiance;
        }
        radiance += throughput * shading.lights.emitted(hit, wo);
        if (depth == maxDepth) return radiance;
        BsdfSample s;
        float lobe = random.next1D();
        if (!shading.materials.bsdf(hit, wo).sample(lobe, random.next2D(), s)) return radiance;
        throughput *= s.weight;
        ray = {offsetRayOrigin(hit.position, hit.positionError, hit.geometricNormal, s.direction),
               s.direction, std::numeric_limits<float>::infinity(), 0};
    }
}

void addMesh(Scene& scene, std::vector<glm::vec3> positions, std::vector<std::uint32_t> indices, int material,
             int light = -1) {
    Mesh mesh;
    mesh.kind = indices.size() == 4 ? Mesh::Kind::bilinearPatches : Mesh::Kind::triangles;
    mesh.positions = std::move(positions);
    mesh.indices = std::move(indices);
    scene.meshes.push_back(std::move(mesh));
    Shape shape;
    shape.meshIndex = int(scene.meshes.size()) - 1;
    shape.materialIndex = material;
    shape.areaLightIndex = light;
    scene.shapes.push_back(shape);
}

/// A corner of a room with a sphere of `material` under a light that hangs low, a second small light, and a
/// sky of brightness `sky` (if above 0).
Scene room(Material material, float sky) {
    Scene scene;
    int grey = test::addDiffuse(scene, {0.7f, 0.5f, 0.3f});
    scene.materials.push_back(material);
    AreaLight lamp;
    lamp.radiance = {4, 3, 2};
    AreaLight small;
    small.radiance = glm::vec3(20);
    small.twoSided = true;
    scene.areaLights = {lamp, small};
    addMesh(scene, {{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}}, {0, 1, 2, 0, 2, 3}, grey);
    addMesh(scene, {{-3, 3, 0}, {3, 3, 0}, {3, 3, 4}, {-3, 3, 4}}, {0, 1, 2, 0, 2, 3}, grey);
    addMesh(scene, {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}}, {0, 2, 1, 0, 3, 2}, grey, 0);
    addMesh(scene, {{2, 0, 0.5f}, {2, 0.5f, 0.5f}, {2, 0, 1}, {2, 0.5f, 1}}, {0, 1, 2, 3}, grey, 1);
    Shape sphere;
    sphere.kind = ShapeKind::sphere;
    sphere.radius = 0.8f;
    sphere.zMin = -0.8f;
    sphere.zMax = 0.8f;
    sphere.materialIndex = grey + 1;
    sphere.worldFromObject.at.fill(glm::translate(glm::dmat4(1), glm::dvec3(0.2, 0.4, 0.8)));
    scene.shapes.push_back(sphere);
    if (sky > 0) {
        Light light;
        light.kind = LightKind::infinite;
        light.emission = glm::vec3(sky);
        scene.lights.push_back(light);
    }
    return scene;
}

Material withRoughness(Scene& textures, MaterialKind kind, float roughness) {
    Material m;
    m.kind = kind;
    m.reflectance = test::addConstant(textures, {0.9f, 0.6f, 0.4f});
    m.transmittance = test::addConstant(textures, {0.1f, 0.3f, 0.5f});
    m.uRoughness = m.vRoughness = test::addConstant(textures, glm::vec3(roughness));
    m.baseURoughness = m.baseVRoughness = test::addConstant(textures, glm::vec3(0.1f));
    m.thickness = test::addConstant(textures, glm::vec3(0.01f));
    return m;
}

/// Mean over rays from a camera in front of the room.
template <typename Trace>
Estimate picture(int count, const Trace& trace) {
    Random random(17);
    return average(count, [&] {
        glm::vec3 target(3 * random.next1D() - 1.5f, 1, 2 * random.next1D());
        Ray ray;
        ray.origin = {0.5f, -2.9f, 1.2f};
        ray.direction = glm::normalize(target - ray.origin);
        return double(trace(ray, random).y);
    });
}

TEST(Path, equalsAPathTracerThatNeverSamplesLights) {
    for (MaterialKind kind :
         {MaterialKind::diffuse, MaterialKind::coatedDiffuse, MaterialKind::conductor,
          MaterialKind::coatedConductor, MaterialKind::dielectric, MaterialKind::diffuseTransmission})
        for (float roughness : {0.f, 0.2f})
            for (int maxDepth : {1, 3}) {
                if ((kind == MaterialKind::diffuse || kind == MaterialKind::diffuseTransmission) &&
                    roughness > 0)
                    continue;
                Scene textures;
                Material material = withRoughness(textures, kind, roughness);
                Scene scene = room(material, maxDepth == 1 ? 0.3f : 0);
                scene.textures.insert(scene.textures.begin(), textures.textures.begin(),
                                      textures.textures.end());
                scene.materials[0].reflectance = int(scene.textures.size()) - 1;
                Shading shading(scene);
                BruteForce geometry(scene);
                Estimate ours = picture(30000, [&](const Ray& ray, Random& random) {
                    return tracePath(geometry, shading, ray, maxDepth, random);
                });
                Estimate truth = picture(100000, [&](const Ray& ray, Random& random) {
                    return naivePath(geometry, shading, ray, maxDepth, random);
                });
                EXPECT_NEAR(ours.mean, truth.mean, 4 * std::hypot(ours.error, truth.error))
                    << int(kind) << " " << roughness << " " << maxDepth;
                EXPECT_LT(ours.error * std::sqrt(30000),
                          truth.error * std::sqrt(100000.0)); // and is less noisy
            }
}

TEST(Path, lightsThatNeedTwoStrategiesAndMovingOnes) {
    Scene scene = room(Material{}, 0);
    scene.materials[1].reflectance = 0;
    // A bent light: not sampled by solid angle. Its hits here come from two flat triangles nearly in place.
    scene.meshes[3].positions[3] += glm::vec3(2e-4f, 0, 0);
    Shading bent(scene);
    EXPECT_FALSE(bent.lights.complete());
    BruteForce geometry(scene);
    auto compare = [&](const Shading& shading) {
        Estimate ours = picture(
            30000, [&](const Ray& ray, Random& r) { return tracePath(geometry, shading, ray, 1, r); });
        Estimate truth = picture(
            150000, [&](const Ray& ray, Random& r) { return naivePath(geometry, shading, ray, 1, r); });
        EXPECT_NEAR(ours.mean, truth.mean, 4 * std::hypot(ours.error, truth.error));
    };
    compare(bent);
    scene.shapes[2].worldFromObject.at[1] = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 1e-6));
    Shading moving(scene);
    EXPECT_FALSE(moving.lights.complete());
    compare(moving);
}

TEST(Path, depthMeansWhatPbrtMeans) {
    Scene textures;
    Material mirror = withRoughness(textures, MaterialKind::conductor, 0);
    Scene scene = room(mirror, 0);
    scene.textures.insert(scene.textures.begin(), textures.textures.begin(), textures.textures.end());
    scene.materials[0].reflectance = int(scene.textures.size()) - 1;
    Shading shading(scene);
    BruteForce geometry(scene);
    Random random;
    Ray up;
    up.origin = {0.9f, -0.9f, 0.5f};
    up.direction = {0, 0, 1};
    EXPECT_EQ(tracePath(geometry, shading, up, 0, random), glm::vec3(4, 3, 2)); // light seen directly
    Ray down = up;
    down.direction = {0, 0, -1};
    EXPECT_EQ(tracePath(geometry, shading, down, 0, random), glm::vec3(0));
    EXPECT_GT(average(100, [&] { return double(tracePath(geometry, shading, down, 1, random).x); }).mean,
              0.2);
    // The top of the mirror ball shows the lamp after one bounce, but the floor only after two.
    Ray onTop;
    onTop.origin = {0.2f, 0.4f, 1.9f};
    onTop.direction = {0, 0, -1};
    EXPECT_NEAR(tracePath(geometry, shading, onTop, 1, random).x, 4 * 0.9f, 0.01f);
    EXPECT_EQ(tracePath(geometry, shading, onTop, 0, random).x, 0);
    Ray side;
    side.origin = {0.2f, -2, 0.5f};
    side.direction = {0, 1, 0};
    EXPECT_EQ(tracePath(geometry, shading, side, 1, random).x, 0);
    EXPECT_GT(average(200, [&] { return double(tracePath(geometry, shading, side, 2, random).x); }).mean, 0);
}

TEST(Path, auxiliaryChannelsDescribeTheFirstHit) {
    Scene scene = room(Material{}, 0);
    scene.materials[1].reflectance = 0;
    Shading shading(scene);
    BruteForce geometry(scene);
    Random random;
    Ray down;
    down.origin = {2, -2, 1};
    down.direction = {0, 0, -3}; // camera rays need not be of unit length
    PathState state = startPath(down);
    SurfaceHit hit;
    ShadowRay shadow;
    SurfaceGuides guides;
    ASSERT_TRUE(geometry.intersect(down, hit));
    EXPECT_FALSE(scatter(shading, hit, 0, random, state, shadow, &guides));
    EXPECT_EQ(guides.albedo, glm::vec3(0.7f, 0.5f, 0.3f));
    EXPECT_EQ(guides.reflectance, guides.albedo);
    EXPECT_EQ(guides.normal, glm::vec3(0, 0, 1));
    EXPECT_FALSE(shadow.needed());
    EXPECT_FALSE(scatter(shading, SurfaceHit{}, 5, random, state, shadow, &guides));
    EXPECT_EQ(guides.albedo, glm::vec3(0));
}

TEST(Path, oneShadowRayIsAllOfDirectDiffuseLight) {
    Scene scene = room(Material{}, 0.3f);
    scene.materials[1].reflectance = 0;
    Shading shading(scene);
    BruteForce geometry(scene);
    Random random;
    PathState state;
    state.ray.origin = {2, -2, 1};
    state.ray.direction = {0, 0, -1};
    SurfaceHit hit;
    ShadowRay shadow;
    ASSERT_TRUE(geometry.intersect(state.ray, hit));
    EXPECT_FALSE(scatter(shading, hit, 1, random, state, shadow));
    EXPECT_TRUE(shadow.needed());
    EXPECT_NEAR(glm::length(shadow.ray.direction), 1, 1e-5f);
}

TEST(Path, parametersOutsideTheSubsetAreRefused) {
    auto make = [](auto change) {
        Scene scene;
        Material m = withRoughness(scene, MaterialKind::coatedDiffuse, 0);
        change(scene, m);
        scene.materials.push_back(m);
        Materials materials(scene);
    };
    EXPECT_NO_THROW(make([](Scene&, Material&) {}));
    EXPECT_NO_THROW(make([](Scene& s, Material& m) { m.albedo = test::addConstant(s, glm::vec3(0)); }));
    EXPECT_THROW(make([](Scene& s, Material& m) { m.albedo = test::addConstant(s, glm::vec3(0.1f)); }),
                 Error);
    EXPECT_THROW(make([](Scene&, Material& m) { m.reflectance = 77; }), Error);
    EXPECT_THROW(make([](Scene& s, Material& m) {
                     Texture t;
                     t.kind = TextureKind::checkerboard;
                     t.child = {0, 1, -1};
                     s.textures.push_back(t);
                     m.thickness = int(s.textures.size()) - 1;
                 }),
                 Error);
}

} // namespace
} // namespace slant
