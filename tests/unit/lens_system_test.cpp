// Rays through lenses against closed forms, published figures and a trigonometric trace of another kind.
#include "support/expect_error.h"
#include "support/lenses.h"

#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace slant {
namespace {

using test::lensNamed;
using test::lensOf;
using test::rayFromFilm;
using test::wideOpen;

/// A biconvex lens of n = 1.5, R1 = 100, R2 = -80, 6 mm thick, with a stop 2 mm behind it.
const char* const kSingle = "100 6 1.5 40\n-80 2 1 40\n0 0 1 10\n";

TEST(LensSystem, singleLensFollowsTheLensmakersEquation) {
    const LensSystem lens = wideOpen(lensOf(kSingle));
    const double n = 1.5, r1 = 100, r2 = -80, d = 6;
    const double f = 1 / ((n - 1) * (1 / r1 - 1 / r2 + (n - 1) * d / (n * r1 * r2)));
    EXPECT_NEAR(lens.focalLength(), f, 1e-9);
    // Principal planes, from the vertices; the rear "surface" is the stop.
    EXPECT_NEAR(lens.frontPrincipal(), lens.frontVertex() + f * (n - 1) * d / (n * r2), 1e-9);
    EXPECT_NEAR(lens.rearPrincipal(), 2 + f * (n - 1) * d / (n * r1), 1e-9);
    EXPECT_EQ(lens.exitPupil().z, 0);
    EXPECT_EQ(lens.exitPupil().radius, 5);
}

TEST(LensSystem, filmDistanceIsTheInverseOfFocusing) {
    for (const char* name : test::kLensNames) {
        const LensSystem lens = wideOpen(lensNamed(name));
        for (const double focusMm : {8 * lens.nearestFocus(), 1e5}) {
            const double film = lens.filmPosition(focusMm, {});
            const double rear = lens.outline().back().vertex;
            EXPECT_NEAR(lens.focusDistance(rear - film, {}) / focusMm, 1, 1e-6) << name;
        }
    }
    test::expectError(ErrorCode::badInput, "nothing is in focus on a film 1 mm behind this lens",
                      [] { wideOpen(lensNamed(test::kLensNames[0])).focusDistance(1, {}); });
}

TEST(LensSystem, focalLengthsAreThePublishedOnes) {
    const double published[][2] = {{50, 2}, {22, 2.7}, {250, 5.6}, {10, 4}}; // mm, f-number
    for (std::size_t i = 0; i < 4; ++i) {
        const LensSystem lens = wideOpen(lensNamed(test::kLensNames[i]));
        EXPECT_NEAR(lens.focalLength() / published[i][0], 1, 0.01) << test::kLensNames[i];
        EXPECT_NEAR(lens.fNumber() / published[i][1], 1, 0.04) << test::kLensNames[i];
    }
}

TEST(LensSystem, raysNearTheAxisMeetInTheFociAndPassThePupils) {
    for (const char* name : test::kLensNames) {
        const LensSystem lens = wideOpen(lensNamed(name));
        constexpr double kHeight = 1e-3;
        LensRay in{{kHeight, 0, lens.frontVertex() + 5}, {0, 0, -1}};
        ASSERT_TRUE(lens.traceFromScene(in));
        const double crossing = in.origin.z - in.origin.x / in.direction.x * in.direction.z;
        EXPECT_NEAR(crossing, lens.rearFocus(), 1e-6 * lens.focalLength()) << name;
        LensRay out{{kHeight, 0, -5}, {0, 0, 1}};
        ASSERT_TRUE(lens.traceFromFilm(out));
        EXPECT_NEAR(out.origin.z - out.origin.x / out.direction.x * out.direction.z, lens.frontFocus(),
                    1e-6 * lens.focalLength())
            << name;
        // A ray towards the middle of the entrance pupil leaves the middle of the exit pupil.
        const glm::dvec3 entrance(0, 0, lens.entrancePupil().z), far(0.001, 0, lens.frontVertex() + 100);
        LensRay chief{far, glm::normalize(entrance - far)};
        ASSERT_TRUE(lens.traceFromScene(chief));
        EXPECT_NEAR(chief.origin.z - chief.origin.x / chief.direction.x * chief.direction.z,
                    lens.exitPupil().z, 1e-5 * lens.focalLength())
            << name;
    }
}

/// A meridional ray by angles and axis crossings (Conrady's trigonometric formulas), in long double: from the
/// front, at height y parallel to the axis. Returns where it crosses the axis, from the rear vertex.
long double trigonometricFocus(const LensPrescription& lens, long double y) {
    long double u = 0, crossing = 0, n = 1; // crossing: from the vertex of the surface, if u != 0
    bool parallel = true;
    for (const LensSurface& s : lens.surfaces) {
        if (s.radius != 0) {
            const long double r = s.radius;
            const long double incidence = std::asin(parallel ? y / r : (crossing - r) / r * std::sin(u));
            const long double refracted = std::asin(n / s.index * std::sin(incidence));
            u += incidence - refracted;
            crossing = r + r * std::sin(refracted) / std::sin(u);
            n = s.index;
            parallel = false;
        }
        crossing -= s.thickness;
    }
    return crossing + lens.surfaces.back().thickness;
}

TEST(LensSystem, agreesWithATrigonometricTraceInHigherPrecision) {
    for (const char* name : test::kLensNames) {
        const LensPrescription prescription = lensNamed(name);
        const LensSystem lens = wideOpen(prescription);
        for (double y = 0.1; y < 0.9 * lens.entrancePupil().radius; y *= 1.7) {
            LensRay ray{{0.6 * y, 0.8 * y, lens.frontVertex() + 9}, {0, 0, -1}};
            ASSERT_TRUE(lens.traceFromScene(ray)) << name << " at " << y;
            const double crossing = ray.origin.z - ray.origin.x / ray.direction.x * ray.direction.z;
            EXPECT_NEAR(-crossing, double(trigonometricFocus(prescription, y)), 1e-10 * lens.focalLength())
                << name << " at " << y;
            EXPECT_NEAR(ray.direction.x / ray.direction.y, 0.75, 1e-12);
        }
    }
}

/// Calls body with rays from the film that get through.
template <typename Body>
void forRaysThrough(const LensSystem& lens, int count, const Body& body) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int found = 0, tries = 0; found < count; ++tries) {
        ASSERT_LT(tries, 1000 * count);
        const glm::dvec3 film(10 * unit(random), 10 * unit(random), lens.rearFocus());
        const double r = lens.rearRadius();
        LensRay ray = rayFromFilm(film, {r * unit(random), r * unit(random), 0});
        const LensRay start = ray;
        if (!lens.traceFromFilm(ray)) continue;
        ++found;
        body(start, ray);
    }
}

TEST(LensSystem, lightGoesTheSameWayBack) {
    for (const char* name : test::kLensNames) {
        const LensSystem lens = wideOpen(lensNamed(name));
        forRaysThrough(lens, 300, [&](const LensRay& start, const LensRay& end) {
            LensRay back{end.origin + 20.0 * end.direction, -end.direction};
            EXPECT_NEAR(glm::length(end.direction), 1, 1e-12);
            ASSERT_TRUE(lens.traceFromScene(back)) << name;
            const double t = (start.origin.z - back.origin.z) / back.direction.z;
            EXPECT_LT(glm::length(back.origin + t * back.direction - start.origin), 1e-9) << name;
            EXPECT_LT(glm::length(back.direction + start.direction), 1e-11) << name;
        });
    }
}

TEST(LensSystem, derivativesAreThoseOfDifferences) {
    for (const char* name : test::kLensNames) {
        const LensSystem lens = wideOpen(lensNamed(name));
        forRaysThrough(lens, 50, [&](const LensRay& start, const LensRay& end) {
            const glm::dvec3 shift(0.3, -0.7, 0),
                turn = glm::cross(start.direction, glm::dvec3(0.2, 0.5, 0.1));
            std::array<LensRayDerivative, 1> derivative{{{shift, turn}}};
            LensRay same = start;
            ASSERT_TRUE(lens.traceFromFilm(same, derivative));
            constexpr double h = 1e-5;
            std::array<LensRay, 2> moved;
            for (int i = 0; i < 2; ++i) {
                const double step = i == 0 ? -h : h;
                moved[i] = {start.origin + step * shift, glm::normalize(start.direction + step * turn)};
                if (!lens.traceFromFilm(moved[i])) return; // at a rim
            }
            EXPECT_EQ(same.origin, end.origin);
            const glm::dvec3 origin = (moved[1].origin - moved[0].origin) / (2 * h);
            const glm::dvec3 direction = (moved[1].direction - moved[0].direction) / (2 * h);
            EXPECT_LT(glm::length(derivative[0].origin - origin), 1e-5 * (1 + glm::length(origin))) << name;
            EXPECT_LT(glm::length(derivative[0].direction - direction), 1e-5 * (1 + glm::length(direction)));
        });
    }
}

TEST(LensSystem, clearDiametersAndTheStopBlock) {
    const LensPrescription prescription = lensOf(kSingle);
    const LensSystem lens(prescription, 8);
    const auto passes = [&](double x) {
        LensRay ray{{x, 0, -50}, {0, 0, 1}};
        return lens.traceFromFilm(ray);
    };
    EXPECT_TRUE(passes(3.999));
    EXPECT_FALSE(passes(4.001)); // the stop
    const LensSystem open = wideOpen(lensOf("100 6 1.5 6\n-80 2 1 40\n0 0 1 40\n"));
    LensRay parallel{{2.999, 0, 50}, {0, 0, -1}}, outside{{3.001, 0, 50}, {0, 0, -1}};
    EXPECT_TRUE(open.traceFromScene(parallel));
    EXPECT_FALSE(open.traceFromScene(outside));
}

TEST(LensSystem, totalReflectionAndMissesBlock) {
    const LensSystem lens = wideOpen(lensOf("1e5 10 2 20\n-10.5 1 1 20.5\n0 0 1 20\n"));
    LensRay inner{{3, 0, -5}, {0, 0, 1}}, outer{{9.9, 0, -5}, {0, 0, 1}};
    EXPECT_TRUE(lens.traceFromFilm(inner));
    EXPECT_FALSE(lens.traceFromFilm(outer)) << "42 degrees within glass of index 2";
    LensRay beside = rayFromFilm({-60, 0, -5}, {9, 0, 0});
    EXPECT_FALSE(lens.traceFromFilm(beside));
}

TEST(LensSystem, theFilmStandsWhereThePlaneInFocusIsImaged) {
    for (const char* name : test::kLensNames) {
        const LensSystem lens = wideOpen(lensNamed(name));
        for (const double distance : {1.01 * lens.nearestFocus(), 500.0, 1e4, 1e8}) {
            if (distance < lens.nearestFocus()) continue;
            const double film = lens.filmPosition(distance, {});
            const glm::dvec3 object(0, 0, film + distance);
            LensRay ray = rayFromFilm(object, {1e-3, 0, lens.entrancePupil().z});
            ray.origin += (distance - 5 - lens.frontVertex() + film) * ray.direction; // to be more exact
            ASSERT_TRUE(lens.traceFromScene(ray)) << name << " at " << distance;
            EXPECT_NEAR(ray.origin.z - ray.origin.x / ray.direction.x * ray.direction.z, film,
                        1e-5 * lens.focalLength())
                << name << " at " << distance;
        }
        EXPECT_NEAR(lens.filmPosition(1e12, {}), lens.rearFocus(), 1e-6);
        test::expectError(ErrorCode::badInput, "s.pbrt:3:4: this lens cannot focus at", [&] {
            lens.filmPosition(0.99 * lens.nearestFocus(), {"s.pbrt", 3, 4});
        });
    }
}

TEST(LensSystem, refusesWhatFormsNoImage) {
    const auto open = [](const char* table) { wideOpen(lensOf(table)); };
    test::expectError(ErrorCode::badInput, "lens.dat: the lens forms no image: its power is -",
                      [&] { open("-100 3 1.5 20\n80 2 1 20\n0 0 1 10\n"); });
    test::expectError(ErrorCode::badInput, "forms no image: its power is 0 per metre",
                      [&] { open("0 1 1 10\n50 0 1 20\n"); });
    // A long rod has its focus within.
    const LensSystem rod = wideOpen(lensOf("0 1 1 10\n30 200 1.5 20\n-400 0 1 20\n"));
    test::expectError(ErrorCode::badInput, "within the lens", [&] {
        rod.filmPosition(1e5, {"s.pbrt", 1, 1});
    });
    const LensSystem window = wideOpen(lensOf("1e5 1 1.5 40\n1e5 900 1 40\n" + std::string(kSingle)));
    test::expectError(ErrorCode::badInput,
                      "the plane in focus, 500 mm from the film, would lie within the lens",
                      [&] { window.filmPosition(500, {}); });
}

} // namespace
} // namespace slant
