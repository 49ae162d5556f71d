// Every light against irradiances known in closed form or by quadrature.
#include "shading_scene.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

using test::average;
using test::Estimate;
using test::Random;

constexpr int kSamples = 40000;

/// Irradiance at a receiver, estimated by sampling the lights.
Estimate irradiance(const Lights& lights, const Receiver& receiver, int samples = kSamples) {
    Random random;
    return average(samples, [&] {
        LightSample s;
        float choice = random.next1D();
        if (!lights.sample(receiver, choice, random.next2D(), s)) return 0.0;
        return double(s.radiance.y * std::max(0.f, glm::dot(s.direction, receiver.normal)) / s.pdf);
    });
}

void expectMean(const Estimate& e, double expected) {
    EXPECT_NEAR(e.mean, expected, 4 * e.error + 2e-5 * std::abs(expected));
}

/// Irradiance at the origin (normal z) from a rectangle of radiance 1 at z = h, with corner (0, 0) above the
/// origin and sides a, b parallel to the axes (configuration factor 4 of Howell's catalogue, B-3 times pi).
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

TEST(Lights, RectangleOfTrianglesFromFarAndNear) {
    for (float height : {5.f, 1.f, 0.2f, 0.01f}) {
        Scene scene;
        AreaLight light;
        light.radiance = glm::vec3(2);
        light.scale = 1.5f;
        test::addEmittingMesh(scene, rectangle(-1, 2, -1.5f, 0.5f, height), light);
        Lights lights(scene);
        double e = cornerRectangle(1, 1.5, height) + cornerRectangle(2, 1.5, height) +
                   cornerRectangle(1, 0.5, height) + cornerRectangle(2, 0.5, height);
        expectMean(irradiance(lights, {glm::vec3(0), {0, 0, 1}}), 3 * e);
        EXPECT_TRUE(lights.complete());
        // From behind it is dark.
        EXPECT_EQ(irradiance(lights, {{0, 0, 2 * height}, {0, 0, -1}}, 100).mean, 0);
    }
}

} // namespace
} // namespace slant
