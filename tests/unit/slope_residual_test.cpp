// Slope models: closed forms, what lenses without aberrations leave, and the choice.
#include "camera/slope_residual.h"
#include "support/lenses.h"

#include <gtest/gtest.h>
#include <limits>

namespace slant {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

CompoundLens cameraOf(const std::string& lens, double stopDiameterMm, double focusDistance = 1) {
    Film film;
    film.xResolution = 480;
    film.yResolution = 270;
    film.diagonalMm = 24;
    return CompoundLens({test::lensNamed(lens), stopDiameterMm, focusDistance, {}, {}}, {}, film);
}

TEST(SlopeFit, nearTheAxisIsThatOfAThinLens) {
    const CompoundLens camera = cameraOf("dgauss-50mm", 2);
    const LensSystem& lens = camera.lens();
    // A point at infinity is imaged in the rear focus; from there rays spread until they reach the film.
    const double spread = (lens.rearFocus() - camera.filmZ()) / (camera.pupil().planeZ() - lens.rearFocus());
    const double c2 = spread * camera.pupil().radius() / camera.millimetresPerPixel();
    const RadialSlope middle = fitSlopes(camera, 0.5, kInfinity).byRadius.front();
    EXPECT_NEAR(middle.c2.x / c2, 1, 5e-3);
    EXPECT_NEAR(middle.c2.y, middle.c2.x, 1e-3 * c2);
    EXPECT_NEAR(-middle.c1.x / middle.c2.x / camera.focusDepth(), 1, 2e-3);
}

TEST(SlopeResiduals, vanishWithTheAperture) {
    for (const char* name : test::kLensNames) {
        const bool isLong = std::string(name) == "telephoto-250mm";
        const auto worst = [&](double diameter) {
            const CompoundLens camera = cameraOf(name, diameter, isLong ? 5 : 1);
            Residual all;
            for (const DepthResiduals& at : slopeResiduals(camera, camera.focusDepth() / 2, kInfinity)) {
                all.percentile95 = std::max(all.percentile95, at.sample.percentile95);
                all.maximum = std::max(all.maximum, at.sample.maximum);
                EXPECT_GE(at.sample.maximum, at.sample.percentile95);
                EXPECT_GE(at.radius.percentile95, 0);
            }
            return all;
        };
        const double half = test::lensNamed(name).surfaces[test::lensNamed(name).stop].diameter / 2;
        const Residual open = worst(half), closed = worst(half / 4);
        EXPECT_LT(closed.percentile95, 0.1) << name;
        EXPECT_GT(open.percentile95, 8 * closed.percentile95)
            << name << ": aberrations grow faster than blur";
    }
}

TEST(SlopeResiduals, threeDepthsWithTheSmallestBlurInFocus) {
    const CompoundLens camera = cameraOf("wide-22mm", 3);
    const auto residuals = slopeResiduals(camera, camera.focusDepth() / 2, kInfinity);
    ASSERT_EQ(residuals.size(), 3u);
    EXPECT_EQ(residuals[1].depth, camera.focusDepth());
    EXPECT_LT(residuals[1].blurPx, 0.5);
    EXPECT_GT(residuals[0].blurPx, 2 * residuals[1].blurPx);
    EXPECT_EQ(slopeResiduals(camera, 2 * camera.focusDepth(), kInfinity).size(), 2u);
}

TEST(SlopeResiduals, theLowestRungWithinTheToleranceIsChosen) {
    DepthResiduals at;
    at.lens.percentile95 = 0.4;
    at.radiusMean.percentile95 = 0.3;
    at.sampleMean.percentile95 = 0.2;
    const auto chosen = [&](double tolerance) { return selectSlopeFit({at, {}}, tolerance); };
    EXPECT_EQ(chosen(0.5), SlopeFitKind::lens);
    EXPECT_EQ(chosen(0.35), SlopeFitKind::filmRadius);
    EXPECT_EQ(chosen(0.25), SlopeFitKind::sample);
    EXPECT_EQ(chosen(0.1), SlopeFitKind::sample) << "the best there is";
    at.radiusMean.percentile95 = 0.15;
    EXPECT_EQ(chosen(0.1), SlopeFitKind::filmRadius);
}

TEST(SlopeResiduals, twoConstantsAreExactOnTheScenesSide) {
    for (const char* name : test::kLensNames) {
        const bool isLong = std::string(name) == "telephoto-250mm";
        const double diameter = test::lensNamed(name).surfaces[test::lensNamed(name).stop].diameter;
        const CompoundLens camera = cameraOf(name, diameter, isLong ? 5 : 1);
        for (const DepthResiduals& at : slopeResiduals(camera, camera.focusDepth() / 2, kInfinity)) {
            EXPECT_LT(at.scene.percentile95, 0.1) << name;
            EXPECT_LT(at.scene.maximum, 0.5) << name;
            EXPECT_GT(at.lens.percentile95, 3 * at.scene.percentile95) << name;
        }
    }
}

} // namespace
} // namespace slant
