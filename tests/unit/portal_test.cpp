// An infinite light behind a portal is a rectangle that shines to one side.
#include "shading_scene.h"
#include "support/scene_text.h"
#include "trace/geometry.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

using test::average;
using test::Estimate;
using test::Random;
using test::worldOf;

const std::string kFloor = "Material \"diffuse\" \"rgb reflectance\" [1 1 1] Shape \"bilinearmesh\" "
                           "\"point3 P\" [ -9 -9 0  9 -9 0  -9 9 0  9 9 0 ]\n";

/// Mean of the radiance of the floor at a place, by paths of one bounce.
Estimate floorAt(const Scene& scene, float x) {
    SilentMonitor monitor;
    const Geometry geometry(scene, monitor);
    const Shading shading(scene);
    Random random;
    return average(20000, [&] {
        return double(tracePath(geometry, shading, {{x, 0.3f, 1}, {0, 0, -1}}, 1, random).x);
    });
}

TEST(Portal, shinesAsARectangleOfTheSameRadiance) {
    // p03 x p01 points up, away from the floor: so the floor sees the sky through it.
    const Scene portal = worldOf("LightSource \"infinite\" \"rgb L\" [2 2 2] "
                                 "\"point3 portal\" [ -1 -1 2  -1 1 2  1 1 2  1 -1 2 ]\n" +
                                 kFloor);
    const Scene turned = worldOf("LightSource \"infinite\" \"rgb L\" [2 2 2] "
                                 "\"point3 portal\" [ -1 -1 2  1 -1 2  1 1 2  -1 1 2 ]\n" +
                                 kFloor);
    const Scene lamp =
        worldOf(kFloor + "AreaLightSource \"diffuse\" \"rgb L\" [2 2 2] ReverseOrientation "
                         "Shape \"bilinearmesh\" \"point3 P\" [ -1 -1 2  1 -1 2  -1 1 2  1 1 2 ]\n");
    for (const float x : {0.f, 3.f}) {
        const Estimate ours = floorAt(portal, x), truth = floorAt(lamp, x);
        EXPECT_NEAR(ours.mean, truth.mean, 4 * std::hypot(ours.error, truth.error)) << x;
        EXPECT_GT(truth.mean, 0.01);
        EXPECT_EQ(floorAt(turned, x).mean, 0) << "seen from its dark side";
    }
}

TEST(Portal, mustBeARectangle) {
    const auto make = [](const std::string& corners) {
        return Lights(worldOf("LightSource \"infinite\" \"point3 portal\" [" + corners + "]"));
    };
    EXPECT_NO_THROW(make("0 0 0  0 1 0  2 1 0  2 0 0"));
    EXPECT_THROW(make("0 0 0  0 1 0  2 1 1  2 0 0"), Error);
    EXPECT_THROW(make("0 0 0  0 1 0  3 1 0  3 0.5 0"), Error);
    EXPECT_THROW(make("0 0 0  0 0 0  0 0 0  0 0 0"), Error);
}

} // namespace
} // namespace slant
