// Every light against irradiances known in closed form or by quadrature, and densities against samples.
#include "shading_scene.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace slant {
namespace {

using test::average;
using test::Estimate;
using test::Random;

const Receiver kUp{glm::vec3(0), {0, 0, 1}};

/// Irradiance at a receiver, estimated by sampling the lights.
Estimate irradiance(const Lights& lights, const Receiver& receiver, int samples = 40000) {
    Random random;
    return average(samples, [&] {
        LightSample s;
        float choice = random.next1D();
        if (!lights.sample(receiver, choice, random.next2D(), s)) return 0.0;
        return double(s.radiance.y * std::max(0.f, glm::dot(s.direction, receiver.normal)) / s.pdf);
    });
}

void expectMean(const Estimate& e, double expected) {
    EXPECT_NEAR(e.mean, expected, 4 * e.error + 1e-4 * std::abs(expected));
}

AreaLight emits(float radiance, bool twoSided = false) {
    AreaLight light;
    light.radiance = glm::vec3(radiance);
    light.twoSided = twoSided;
    return light;
}

/// Irradiance at the origin (normal z) from a rectangle of radiance 1 at z = h, with a corner above the
/// origin and sides a, b parallel to the axes (Howell's catalogue of configuration factors, B-3, times pi).
double cornerRectangle(double a, double b, double h) {
    double p = std::sqrt(a * a + h * h), q = std::sqrt(b * b + h * h);
    return 0.5 * (a / p * std::atan(b / p) + b / q * std::atan(a / q));
}

Mesh rectangle(float x0, float x1, float y0, float y1, float z) {
    Mesh mesh;
    mesh.positions = {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
    mesh.indices = {0, 2, 1, 0, 3, 2}; // faces down
    return mesh;
}

Mesh patch(glm::vec3 p00, glm::vec3 p10, glm::vec3 p01, glm::vec3 p11) {
    Mesh mesh;
    mesh.kind = Mesh::Kind::bilinearPatches;
    mesh.positions = {p00, p10, p01, p11};
    mesh.indices = {0, 1, 2, 3};
    return mesh;
}

/// Irradiance at `receiver` from a surface of radiance 1 given as a map of the unit square; it emits on the
/// side of du x dv.
double quadrature(const Receiver& receiver, const std::function<glm::dvec3(double, double)>& surface) {
    constexpr int kSteps = 600;
    double sum = 0, h = 1e-5;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            double u = (i + 0.5) / kSteps, v = (j + 0.5) / kSteps;
            glm::dvec3 n =
                glm::cross(surface(u + h, v) - surface(u - h, v), surface(u, v + h) - surface(u, v - h)) /
                (4 * h * h);
            glm::dvec3 d = surface(u, v) - glm::dvec3(receiver.position);
            double r2 = glm::dot(d, d), in = glm::dot(d, glm::dvec3(receiver.normal)), out = -glm::dot(d, n);
            sum += std::max(0.0, in) * std::max(0.0, out) / (r2 * r2);
        }
    return sum / (kSteps * kSteps);
}

TEST(Lights, rectangleFromFarAndNear) {
    for (float height : {5.f, 1.f, 0.2f, 0.01f})
        for (bool patches : {false, true}) {
            Scene scene;
            AreaLight light = emits(2);
            light.scale = 1.5f;
            Mesh mesh = patches ? patch({-1, -1.5f, height}, {-1, 0.5f, height}, {2, -1.5f, height},
                                        {2, 0.5f, height})
                                : rectangle(-1, 2, -1.5f, 0.5f, height);
            test::addEmittingMesh(scene, mesh, light);
            Lights lights(scene);
            double e = cornerRectangle(1, 1.5, height) + cornerRectangle(2, 1.5, height) +
                       cornerRectangle(1, 0.5, height) + cornerRectangle(2, 0.5, height);
            expectMean(irradiance(lights, kUp), 3 * e);
            EXPECT_TRUE(lights.complete());
            // From behind it is dark.
            EXPECT_EQ(irradiance(lights, {{0, 0, 2 * height}, {0, 0, -1}}, 100).mean, 0);
        }
}

TEST(Lights, orientationDecidesWhichSideShines) {
    auto mean = [](bool reverse, bool mirror, bool twoSided, std::vector<glm::vec3> normals) {
        Scene scene;
        Mesh mesh = rectangle(-1, 1, -1, 1, 1);
        mesh.normals = std::move(normals);
        test::addEmittingMesh(scene, mesh, emits(1, twoSided));
        scene.shapes[0].reverseOrientation = reverse;
        if (mirror) scene.shapes[0].worldFromObject.at.fill(glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1)));
        return irradiance(Lights(scene), kUp, 2000).mean;
    };
    EXPECT_GT(mean(false, false, false, {}), 0);
    EXPECT_EQ(mean(true, false, false, {}), 0);
    EXPECT_EQ(mean(true, true, false, {}), 0);
    EXPECT_GT(mean(false, true, false, {}),
              0); // mirrored vertices turn the cross product, pbrt turns it back
    EXPECT_GT(mean(true, false, true, {}), 0);
    std::vector<glm::vec3> down(4, glm::vec3(0, 0, -1)), up(4, glm::vec3(0, 0, 1));
    EXPECT_GT(mean(false, false, false, down), 0); // shading normals decide
    EXPECT_EQ(mean(false, false, false, up), 0);
    EXPECT_GT(mean(true, false, false, up), 0);
}

TEST(Lights, twistedPatch) {
    glm::vec3 p00(-1, -1, 1), p10(-1, 1, 2), p01(1, -1, 2.5f), p11(1.5f, 1, 0.7f);
    Scene scene;
    test::addEmittingMesh(scene, patch(p00, p10, p01, p11), emits(1));
    Lights lights(scene);
    EXPECT_FALSE(lights.complete());
    glm::dvec3 a(p00), b(p10), c(p01), d(p11);
    double truth = quadrature(kUp, [&](double u, double v) {
        return (1 - u) * (1 - v) * a + u * (1 - v) * b + (1 - u) * v * c + u * v * d;
    });
    expectMean(irradiance(lights, kUp, 200000), truth);
}

TEST(Lights, sphereFromOutsideAndInside) {
    Scene scene;
    Shape sphere;
    sphere.kind = ShapeKind::sphere;
    sphere.radius = 0.5f;
    sphere.zMin = -0.5f;
    sphere.zMax = 0.5f;
    sphere.worldFromObject.at.fill(glm::translate(glm::dmat4(1), glm::dvec3(0, 1, 2)));
    test::addEmittingShape(scene, sphere, emits(3, true));
    Lights lights(scene);
    // L pi (r / d)^2 cos.
    double d2 = 5, expected = 3 * double(kPi) * 0.25 / d2 * (2 / std::sqrt(d2));
    expectMean(irradiance(lights, kUp), expected);
    expectMean(irradiance(lights, {{0.1f, 1.2f, 1.9f}, {0, 0, 1}}), 3 * double(kPi));
    expectMean(irradiance(lights, {{0, 0, 2000}, {0, 0, -1}}), 3 * double(kPi) * 0.25 / (1 + 1998.0 * 1998));
}

TEST(Lights, discAndCutOrStretchedSphere) {
    Scene scene;
    Shape disc;
    disc.kind = ShapeKind::disk;
    disc.radius = 2;
    disc.innerRadius = 0.5f;
    disc.height = 0.5f;
    disc.reverseOrientation = true;
    disc.worldFromObject.at.fill(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 2.5)));
    test::addEmittingShape(scene, disc, emits(1));
    // pi r^2 / (r^2 + h^2) for a disc on the axis.
    expectMean(irradiance(Lights(scene), kUp), double(kPi) * (4 / 13.0 - 0.25 / 9.25));

    Scene second;
    Shape cut;
    cut.kind = ShapeKind::sphere;
    cut.zMin = -0.8f;
    cut.zMax = 0.3f;
    cut.phiMaxDegrees = 250;
    glm::dmat4 m = glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0.3, 3));
    cut.worldFromObject.at.fill(glm::scale(m, glm::dvec3(1, 1.5, 0.7)));
    test::addEmittingShape(second, cut, emits(1));
    double phiMax = glm::radians(250.0);
    double truth = quadrature(kUp, [&](double u, double v) {
        double z = -0.8 + 1.1 * v, r = std::sqrt(1 - z * z);
        return glm::dvec3(cut.worldFromObject.at[0] *
                          glm::dvec4(r * std::cos(phiMax * u), r * std::sin(phiMax * u), z, 1));
    });
    expectMean(irradiance(Lights(second), kUp, 200000), truth);
}

TEST(Lights, pointDistantAndSky) {
    Scene scene;
    Light point;
    point.emission = glm::vec3(2, 5, 1);
    point.scale = 2;
    point.from = {0, 3, 4};
    scene.lights = {point};
    expectMean(irradiance(Lights(scene), kUp, 10), 10 / 25.0 * 0.8);
    scene.lights[0].power = 4 * kPi;
    expectMean(irradiance(Lights(scene), kUp, 10),
               10 / 25.0 * 0.8); // the intensity is 1 W/sr times I and scale

    Light distant;
    distant.kind = LightKind::distant;
    distant.emission = glm::vec3(3);
    distant.from = {0, 3, 4};
    distant.to = {0, 0, 0};
    scene.lights = {distant};
    expectMean(irradiance(Lights(scene), kUp, 10), 3 * 0.8);
    scene.lights[0].illuminance = 7;
    expectMean(irradiance(Lights(scene), kUp, 10), 21 * 0.8);
    scene.lights[0].to = scene.lights[0].from;
    EXPECT_THROW(Lights{scene}, Error);

    Light sky;
    sky.kind = LightKind::infinite;
    sky.emission = glm::vec3(0.5f);
    scene.lights = {sky};
    expectMean(irradiance(Lights(scene), kUp, 1000), 0.5 * double(kPi));
    scene.lights[0].illuminance = 8;
    expectMean(irradiance(Lights(scene), kUp, 1000), 4);
    EXPECT_TRUE(Lights(scene).complete());
}

/// Light of a scene with a bit of everything; every sample's density is found again by pdf().
TEST(Lights, densitiesAreThoseOfTheSamples) {
    Scene scene;
    test::addEmittingMesh(scene, rectangle(-1, 2, -1.5f, 0.5f, 1), emits(2));
    test::addEmittingMesh(scene, patch({-3, -1, 1}, {-3, 1, 2}, {-1, -1, 2.5f}, {-1.5f, 1, 0.7f}), emits(1));
    test::addEmittingMesh(scene, patch({3, -1, 1}, {3, 1, 1}, {5, -1, 1}, {5, 1, 1}), emits(1));
    Shape sphere;
    sphere.kind = ShapeKind::sphere;
    sphere.worldFromObject.at.fill(glm::translate(glm::dmat4(1), glm::dvec3(0, 4, 2)));
    test::addEmittingShape(scene, sphere, emits(1));
    Shape disc;
    disc.kind = ShapeKind::disk;
    disc.worldFromObject.at.fill(glm::translate(glm::dmat4(1), glm::dvec3(0, -4, 2)));
    disc.reverseOrientation = true;
    test::addEmittingShape(scene, disc, emits(1));
    Light sky;
    sky.kind = LightKind::infinite;
    sky.scale = 0.1f;
    scene.lights = {sky};
    Lights lights(scene);
    Random random;
    std::array<int, 5> met{};
    for (int i = 0; i < 20000; ++i) {
        LightSample s;
        float choice = random.next1D();
        if (!lights.sample(kUp, choice, random.next2D(), s)) continue;
        if (std::isinf(s.distance)) {
            ASSERT_NEAR(lights.infinitePdf(kUp, 0, s.direction), s.pdf, 1e-3f * s.pdf);
            continue;
        }
        SurfaceHit hit;
        hit.position = s.direction * s.distance;
        glm::vec3 p = hit.position;
        hit.geometricNormal = {0, 0, -1};
        if (p.y > 2.5f) {
            hit.emitter = {3, 0};
            hit.geometricNormal = glm::normalize(p - glm::vec3(0, 4, 2));
        } else if (p.y < -2.5f)
            hit.emitter = {4, 0};
        else if (p.x > 2.5f)
            hit.emitter = {2, 0};
        else if (p.x > -1 + 1e-4f &&
                 std::abs(p.x + 1 - (p.y + 1.5f) * 1.5f) > 1e-4f) // not on the common edge
            hit.emitter = {0, p.x + 1 > (p.y + 1.5f) * 1.5f ? 0 : 1};
        else
            continue; // the bent patch has a test of its own
        ++met[std::size_t(hit.emitter.light)];
        float pdf = lights.pdf(kUp, hit, s.direction);
        ASSERT_NEAR(pdf, s.pdf, 2e-3f * s.pdf)
            << hit.emitter.light << " " << hit.emitter.primitive << " at " << p.x << " " << p.y << " " << p.z;
        EXPECT_EQ(lights.complete(hit), hit.emitter.light != 4);
    }
    for (int light : {0, 2, 3, 4}) EXPECT_GT(met[std::size_t(light)], 100);
}

TEST(Lights, bentPatchDensityIsFoundFromThePosition) {
    Emitter e;
    e.shape = Emitter::Shape::patch;
    e.origin = {-1, -1, 1};
    e.edge1 = {0, 2, 1};
    e.edge2 = {2, 0, 1.5f};
    e.twist = {0.5f, 0, -2.8f};
    e.twoSided = true;
    Random random;
    for (int i = 0; i < 1000; ++i) {
        glm::vec2 uv = random.next2D();
        glm::vec3 q = e.origin + uv.x * e.edge1 + uv.y * e.edge2 + uv.x * uv.y * e.twist;
        glm::vec3 cross = glm::cross(e.edge1 + uv.y * e.twist, e.edge2 + uv.x * e.twist);
        float area = glm::length(cross);
        glm::vec3 n = cross / area, d = glm::normalize(q);
        float expected = glm::dot(q, q) / (area * std::abs(glm::dot(d, n)));
        ASSERT_NEAR(emitterPdf(e, {}, kUp, d, q, n), expected, 1e-3f * expected);
    }
}

TEST(Lights, manyEmittersAreChosenWithoutBias) {
    Scene scene;
    Random random(4);
    double expected = 0;
    for (int i = 0; i < 300; ++i) {
        Light point;
        point.from = {20 * random.next1D() - 10, 20 * random.next1D() - 10, 6 * random.next1D() - 2};
        point.emission = glm::vec3(i % 50 == 0 ? 100.f : random.next1D());
        scene.lights.push_back(point);
        double d2 = double(glm::dot(point.from, point.from));
        if (point.from.z > 0) expected += double(point.emission.y * point.from.z) / (d2 * std::sqrt(d2));
    }
    Lights lights(scene);
    Estimate e = irradiance(lights, kUp, 100000);
    expectMean(e, expected);
    EXPECT_LT(e.error / e.mean * std::sqrt(100000.0), 2); // far better than choosing evenly
}

TEST(Lights, chancesOfATreeAddUpToOne) {
    Random random(9);
    std::vector<LightBounds> bounds(100);
    for (LightBounds& b : bounds) {
        b.low = b.high = 10.f * glm::vec3(random.next1D(), random.next1D(), random.next1D()) - 5.f;
        b.high += 0.3f;
        b.axis = warpToSphere(random.next2D());
        b.intensity = random.next1D();
    }
    LightTree tree(bounds);
    Receiver receiver{{1, 0.5f, -1}, glm::normalize(glm::vec3(1, 2, 3))};
    double sum = 0;
    for (int i = 0; i < 100; ++i) {
        float chance = tree.chance(receiver, i);
        sum += double(chance);
        // Whoever may contribute has a chance: the box reaches above the horizon and its normals turn here.
        glm::vec3 d = bounds[std::size_t(i)].high - receiver.position;
        bool may = glm::dot(d, receiver.normal) > 0 && glm::dot(d, bounds[std::size_t(i)].axis) < 0;
        EXPECT_TRUE(chance > 0 || !may) << i;
    }
    std::vector<int> counts(100);
    int none = 0; // a group seemed to contribute, but nothing in it does
    for (int i = 0; i < 100000; ++i) {
        float u = random.next1D(), chance;
        int index = tree.sample(receiver, u, chance);
        if (index < 0) {
            ++none;
            continue;
        }
        ASSERT_FLOAT_EQ(chance, tree.chance(receiver, index));
        ASSERT_TRUE(u >= 0 && u < 1);
        ++counts[std::size_t(index)];
    }
    EXPECT_NEAR(sum, 1 - none / 100000.0, 0.01);
    for (int i = 0; i < 100; ++i) {
        float expected = 100000 * tree.chance(receiver, i);
        EXPECT_NEAR(float(counts[std::size_t(i)]), expected, 5 * std::sqrt(expected) + 1);
    }
}

TEST(Lights, powerIsWhatAPieceEmits) {
    auto flux = [](Scene scene, double area) { // pi A L, by the radiance of a hit
        scene.areaLights[0].power = 12;
        scene.areaLights[0].radiance = glm::vec3(1, 0.5f, 0.25f);
        Lights lights(scene);
        SurfaceHit hit;
        hit.emitter = {0, 0};
        hit.geometricNormal = {0, 0, 1};
        double sides = scene.areaLights[0].twoSided ? 2 : 1;
        return double(kPi) * area * sides * double(lights.emitted(hit, {0, 0, 1}).x);
    };
    Scene triangles;
    test::addEmittingMesh(triangles, rectangle(0, 2, 0, 3, 1), emits(1));
    EXPECT_NEAR(flux(triangles, 3), 12, 1e-4); // each triangle, as in pbrt
    triangles.areaLights[0].twoSided = true;
    EXPECT_NEAR(flux(triangles, 3), 12, 1e-4);
    Scene flat;
    test::addEmittingMesh(flat, patch({0, 0, 1}, {0, 2, 1}, {3, 0, 1}, {3, 2, 1}), emits(1));
    EXPECT_NEAR(flux(flat, 6), 12, 1e-4);
    Scene ball;
    Shape sphere;
    sphere.kind = ShapeKind::sphere;
    sphere.worldFromObject.at.fill(glm::scale(glm::dmat4(1), glm::dvec3(2)));
    test::addEmittingShape(ball, sphere, emits(1));
    EXPECT_NEAR(flux(ball, 4 * double(kPi) * 4), 12, 1e-3);
}

} // namespace
} // namespace slant
