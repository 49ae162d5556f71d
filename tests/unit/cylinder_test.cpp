// Cylinders against their definition, and as lights against rays that find them by chance.
#include "shading_scene.h"
#include "support/scene_text.h"
#include "trace/geometry.h"

#include <gtest/gtest.h>
#include <numbers>

namespace slant {
namespace {

using test::average;
using test::Estimate;
using test::Random;
using test::worldOf;

const std::string kShape = "Translate 0.2 0.1 3 Rotate 50 1 0.3 0 "
                           "Shape \"cylinder\" \"float radius\" 0.5 \"float zmin\" -0.7 \"float zmax\" 1.1 ";

TEST(Cylinder, isWhatItsParametersSay) {
    const Scene scene = worldOf(kShape + "\"float phimax\" 250");
    SilentMonitor monitor;
    const Geometry geometry(scene, monitor);
    const glm::dmat4 matrix = scene.shapes[0].worldFromObject.at[0];
    const double phiMax = 250 * std::numbers::pi / 180;
    const auto pointAt = [&](double u, double v) {
        return glm::dvec3(
            matrix * glm::dvec4(0.5 * std::cos(u * phiMax), 0.5 * std::sin(u * phiMax), -0.7 + 1.8 * v, 1));
    };
    Random random;
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::vec3 target(random.next1D() - 0.5f, random.next1D() - 0.5f, 3);
        SurfaceHit hit;
        if (!geometry.intersect({{0, 0, 0}, glm::normalize(target)}, hit)) continue;
        ++hits;
        const double u = double(hit.uv.x), v = double(hit.uv.y), step = 1e-4;
        EXPECT_TRUE(u >= 0 && u <= 1 && v >= 0 && v <= 1);
        EXPECT_LT(glm::distance(glm::dvec3(hit.position), pointAt(u, v)), 1e-5);
        const glm::dvec3 dpdu = (pointAt(u + step, v) - pointAt(u - step, v)) / (2 * step);
        const glm::dvec3 dpdv = (pointAt(u, v + step) - pointAt(u, v - step)) / (2 * step);
        EXPECT_LT(glm::distance(glm::dvec3(hit.dpdu), dpdu), 1e-4);
        EXPECT_LT(glm::distance(glm::dvec3(hit.dpdv), dpdv), 1e-4);
        EXPECT_GT(glm::dot(glm::dvec3(hit.geometricNormal), glm::normalize(glm::cross(dpdu, dpdv))), 0.99999);
    }
    EXPECT_GT(hits, 500);
}

TEST(Cylinder, shinesFromItsOutside) {
    const Scene scene = worldOf("AreaLightSource \"diffuse\" \"rgb L\" [3 3 3] " + kShape);
    SilentMonitor monitor;
    const Geometry geometry(scene, monitor);
    const Lights lights(scene);
    const Receiver receiver{{0.1f, 0, 0}, {0, 0, 1}, 0};
    Random random;
    const Estimate sampled = average(20000, [&] {
        LightSample s;
        if (!lights.sample(receiver, random.next1D(), random.next2D(), s)) return 0.0;
        SurfaceHit hit; // the inside of the far wall is sampled too, and hidden
        if (geometry.occluded({receiver.position, s.direction, s.distance * 0.999f})) return 0.0;
        return double(s.radiance.x * std::max(0.f, s.direction.z) / s.pdf);
    });
    const Estimate met = average(60000, [&] {
        const glm::vec3 direction = warpToCosineHemisphere(random.next2D());
        SurfaceHit hit;
        if (!geometry.intersect({receiver.position, direction}, hit)) return 0.0;
        EXPECT_GT(lights.pdf(receiver, hit, direction), 0);
        return double(lights.emitted(hit, -direction).x * kPi);
    });
    EXPECT_NEAR(sampled.mean, met.mean, 4 * std::hypot(sampled.error, met.error));
}

} // namespace
} // namespace slant
