// Cylinders, cones, hyperboloids and paraboloids against their definitions, and as lights against rays that
// find them by chance.
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

constexpr double kTurn = 250 * std::numbers::pi / 180;

struct TurnedShape {
    const char* name;
    const char* parameters;
    glm::dvec3 (*pointAt)(double u, double v); ///< in object space
    double area;
};

glm::dvec3 turnedBy(double u, double x, double y, double z) {
    const double c = std::cos(u * kTurn), s = std::sin(u * kTurn);
    return {c * x - s * y, s * x + c * y, z};
}

glm::dvec3 cylinderAt(double u, double v) {
    return turnedBy(u, 0.5, 0, -0.7 + 1.8 * v);
}
glm::dvec3 coneAt(double u, double v) {
    return turnedBy(u, 0.6 * (1 - v), 0, 1.2 * v);
}
glm::dvec3 paraboloidAt(double u, double v) {
    const double z = 0.2 + 1.1 * v;
    return turnedBy(u, 0.7 * std::sqrt(z / 1.3), 0, z);
}
glm::dvec3 hyperboloidAt(double u, double v) {
    return turnedBy(u, 0.7 - 0.9 * v, 0.1 + 0.4 * v, 0.8 - 1.5 * v);
}

/// Of the curve's arc times its way round, by Simpson's rule.
double areaOf(glm::dvec3 (*pointAt)(double, double)) {
    constexpr int kSteps = 2000;
    const auto density = [&](double v) {
        const double d = 1e-5;
        const glm::dvec3 du = (pointAt(d, v) - pointAt(-d, v)) / (2 * d);
        const glm::dvec3 dv = (pointAt(0, v + d) - pointAt(0, v - d)) / (2 * d);
        return glm::length(glm::cross(du, dv));
    };
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double at = (i + 0.5) / kSteps;
        sum += (density(at - 0.5 / kSteps) + 4 * density(at) + density(at + 0.5 / kSteps)) / 6;
    }
    return sum / kSteps;
}

/// Of a paraboloid of this radius and height, from its tip on.
double paraboloidArea(double radius, double height) {
    const double r2 = radius * radius, h2 = height * height;
    return kTurn * radius / (12 * h2) * (std::pow(r2 + 4 * h2, 1.5) - radius * r2);
}

const TurnedShape kShapes[] = {
    {"cylinder", "\"float radius\" 0.5 \"float zmin\" -0.7 \"float zmax\" 1.1", cylinderAt,
     kTurn * 0.5 * 1.8},
    {"cone", "\"float radius\" 0.6 \"float height\" 1.2", coneAt, kTurn / 2 * 0.6 * std::hypot(0.6, 1.2)},
    {"paraboloid", "\"float radius\" 0.7 \"float zmin\" 1.3 \"float zmax\" 0.2", paraboloidAt,
     paraboloidArea(0.7, 1.3) - paraboloidArea(0.7 * std::sqrt(0.2 / 1.3), 0.2)},
    {"hyperboloid", "\"point3 p1\" [0.7 0.1 0.8] \"point3 p2\" [-0.2 0.5 -0.7]", hyperboloidAt,
     areaOf(hyperboloidAt)},
};

std::string textOf(const TurnedShape& shape) {
    return "Translate 0.2 0.1 3 Rotate 50 1 0.3 0 Shape \"" + std::string(shape.name) + "\" " +
           shape.parameters + " \"float phimax\" 250";
}

class TurnedShapes : public ::testing::TestWithParam<TurnedShape> {
protected:
    Scene scene_ = worldOf("AreaLightSource \"diffuse\" \"rgb L\" [3 3 3] " + textOf(GetParam()));
    SilentMonitor monitor_;
    Geometry geometry_{scene_, monitor_};
    Random random_;

    glm::dvec3 pointAt(double u, double v) const {
        return glm::dvec3(scene_.shapes[0].worldFromObject.at[0] * glm::dvec4(GetParam().pointAt(u, v), 1));
    }
};

TEST_P(TurnedShapes, areWhatTheirParametersSay) {
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::vec3 target(random_.next1D() - 0.5f, random_.next1D() - 0.5f, 3);
        SurfaceHit hit;
        if (!geometry_.intersect({{0, 0, 0}, glm::normalize(target)}, hit)) continue;
        ++hits;
        const double u = double(hit.uv.x), v = double(hit.uv.y), step = 1e-4;
        EXPECT_TRUE(u >= 0 && u <= 1 && v >= 0 && v <= 1);
        if (v < 2 * step || v > 1 - 2 * step) continue;
        EXPECT_LT(glm::distance(glm::dvec3(hit.position), pointAt(u, v)), 1e-5);
        const glm::dvec3 dpdu = (pointAt(u + step, v) - pointAt(u - step, v)) / (2 * step);
        const glm::dvec3 dpdv = (pointAt(u, v + step) - pointAt(u, v - step)) / (2 * step);
        EXPECT_LT(glm::distance(glm::dvec3(hit.dpdu), dpdu), 1e-4);
        EXPECT_LT(glm::distance(glm::dvec3(hit.dpdv), dpdv), 1e-4);
        EXPECT_GT(glm::dot(glm::dvec3(hit.geometricNormal), glm::normalize(glm::cross(dpdu, dpdv))), 0.99999);
    }
    EXPECT_GT(hits, 500);
}

TEST_P(TurnedShapes, haveNoHoles) {
    for (int i = 0; i < 3000; ++i) {
        const double u = double(random_.next1D()), v = double(random_.next1D());
        const glm::vec3 target(pointAt(u, v)), direction = warpToSphere(random_.next2D());
        const glm::dvec3 across =
            glm::cross(pointAt(u + 1e-4, v) - pointAt(u, v), pointAt(u, v + 1e-4) - pointAt(u, v));
        if (std::abs(glm::dot(glm::normalize(across), glm::dvec3(direction))) < 0.05)
            continue; // rounding may miss
        SurfaceHit hit;
        ASSERT_TRUE(geometry_.intersect({target - 5.f * direction, direction}, hit)) << u << ' ' << v;
        EXPECT_LT(hit.t, 5 + 1e-3f) << u << ' ' << v;
    }
}

TEST_P(TurnedShapes, haveTheAreaOfTheirFormulas) {
    const Scene scene = worldOf("AreaLightSource \"diffuse\" \"float power\" 7 " + textOf(GetParam()));
    const Lights lights(scene);
    const glm::vec3 from(0, 0, 20), outside(pointAt(0.4, 0.5));
    SurfaceHit hit;
    hit.emitter.light = 0;
    hit.geometricNormal = glm::normalize(from - outside);
    EXPECT_NEAR(lights.emitted(hit, hit.geometricNormal).x, 7 / (std::numbers::pi * GetParam().area),
                1e-3 * 7 / (std::numbers::pi * GetParam().area));
}

const Receiver kReceivers[] = {{{0.1f, 0, 0}, {0, 0, 1}, 0}, {{3, 0, 3}, {-1, 0, 0}, 0}};

TEST_P(TurnedShapes, shineFromOneSide) {
    const Lights lights(scene_);
    double brightest = 0;
    for (const Receiver& receiver : kReceivers) {
        const Frame frame = Frame::around(receiver.normal);
        const Estimate sampled = average(20000, [&] {
            LightSample s;
            if (!lights.sample(receiver, random_.next1D(), random_.next2D(), s)) return 0.0;
            // Far walls are sampled, too, and hidden.
            if (geometry_.occluded({receiver.position, s.direction, s.distance * 0.999f})) return 0.0;
            return double(s.radiance.x * std::max(0.f, glm::dot(s.direction, receiver.normal)) / s.pdf);
        });
        const Estimate met = average(60000, [&] {
            const glm::vec3 direction = frame.toWorld(warpToCosineHemisphere(random_.next2D()));
            SurfaceHit hit;
            if (!geometry_.intersect({receiver.position, direction}, hit)) return 0.0;
            EXPECT_GT(lights.pdf(receiver, hit, direction), 0);
            return double(lights.emitted(hit, -direction).x * kPi);
        });
        EXPECT_NEAR(sampled.mean, met.mean, 4 * std::hypot(sampled.error, met.error));
        brightest = std::max(brightest, met.mean);
    }
    EXPECT_GT(brightest, 0.05);
}

TEST_P(TurnedShapes, areSampledAsTheirDensitySays) {
    const Lights lights(scene_);
    int compared = 0;
    for (const Receiver& receiver : kReceivers)
        for (int i = 0; i < 1000; ++i) {
            LightSample s;
            SurfaceHit hit;
            if (!lights.sample(receiver, random_.next1D(), random_.next2D(), s)) continue;
            if (!geometry_.intersect({receiver.position, s.direction}, hit)) continue;
            if (std::abs(hit.t - s.distance) > 1e-4f) continue;
            if (std::abs(glm::dot(hit.geometricNormal, s.direction)) < 0.1f) continue; // cosines are rounded
            EXPECT_NEAR(lights.pdf(receiver, hit, s.direction) / s.pdf, 1, 2e-3);
            ++compared;
        }
    EXPECT_GT(compared, 100);
}

INSTANTIATE_TEST_SUITE_P(Each, TurnedShapes, ::testing::ValuesIn(kShapes),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(TurnedShapes, haveSoundTips) {
    for (const char* shape : {"\"cone\"", "\"paraboloid\"", "\"hyperboloid\""}) {
        const Scene scene = worldOf("Shape " + std::string(shape));
        SilentMonitor monitor;
        const Geometry geometry(scene, monitor);
        SurfaceHit hit;
        ASSERT_TRUE(geometry.intersect({{0, 0, -5}, {0, 0, 1}}, hit)) << shape;
        EXPECT_TRUE(std::isfinite(glm::dot(hit.geometricNormal, hit.dpdv) + hit.dpdu.x)) << shape;
        EXPECT_NEAR(glm::length(hit.geometricNormal), 1, 1e-5) << shape;
    }
}

} // namespace
} // namespace slant
