#include "report/curves.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slant {

/// For gmock's matchers.
static bool operator==(const Cost& a, const Cost& b) {
    return a.seconds == b.seconds && a.error == b.error;
}

namespace {

using testing::ElementsAre;

/// error = 1 / seconds, in powers of ten from 1 to 1000 seconds.
const std::vector<Cost> kReference = {{1, 1}, {10, 0.1}, {100, 0.01}, {1000, 0.001}};

TEST(Curves, frontHoldsWhatNothingBeats) {
    const std::vector<Cost> costs = {{5, 2}, {1, 9}, {3, 2}, {2, 9}, {4, 3}, {9, 1}, {3, 2}, {1, 10}};
    EXPECT_THAT(paretoFront(costs), ElementsAre(Cost{1, 9}, Cost{3, 2}, Cost{9, 1}));
}

TEST(Curves, frontLeavesOutWhatHasNoPlaceOnAChart) {
    const std::vector<Cost> costs = {{1, NAN}, {2, 0}, {0, 1}, {INFINITY, 0.1}, {3, 1}, {-1, 0.5}};
    EXPECT_THAT(paretoFront(costs), ElementsAre(Cost{3, 1}));
    EXPECT_TRUE(paretoFront({}).empty());
}

TEST(Curves, powerLawsAreFollowedExactly) {
    for (const double error : {0.7, 0.1, 0.05, 0.0123, 0.001}) {
        EXPECT_NEAR(*secondsAt(kReference, error), 1 / error, 1e-9 / error);
        EXPECT_NEAR(*errorAt(kReference, 1 / error), error, 1e-9 * error);
    }
    EXPECT_EQ(secondsAt(kReference, 1), 1);
    EXPECT_EQ(errorAt(kReference, 1000), 0.001);
    const std::vector<Cost> square = {{1, 1}, {100, 0.1}}; // error = seconds^-1/2
    EXPECT_NEAR(*secondsAt(square, 0.5), 4, 1e-12);
}

TEST(Curves, nothingIsSaidBeyondTheEnds) {
    EXPECT_FALSE(secondsAt(kReference, 1.1));
    EXPECT_FALSE(secondsAt(kReference, 0.0009));
    EXPECT_FALSE(errorAt(kReference, 0.9));
    EXPECT_FALSE(errorAt(kReference, 1001));
    EXPECT_FALSE(secondsAt({}, 1));
    const std::vector<Cost> one = {{2, 3}};
    EXPECT_EQ(secondsAt(one, 3), 2);
    EXPECT_FALSE(secondsAt(one, 2));
}

TEST(Curves, gainsWithinBothCurves) {
    const std::vector<Cost> faster = {{0.1, 1}, {100, 0.001}}; // a tenth of the reference's time throughout
    const Gain gain = gainAt(faster, kReference, 0.01);
    EXPECT_NEAR(gain.equalError->value, 10, 1e-9);
    EXPECT_FALSE(gain.equalError->atLeast);
    EXPECT_NEAR(gain.equalTime->value, 10, 1e-9); // the reference's error at 10 s is 0.1
    EXPECT_FALSE(gain.equalTime->atLeast);
}

TEST(Curves, gainsAreBoundsWhereACurveEnds) {
    // Below the error from the start: at most 2 s are needed.
    const Gain cheap = gainAt(std::vector<Cost>{{2, 0.004}, {5, 0.003}}, kReference, 0.01);
    EXPECT_NEAR(cheap.equalError->value, 50, 1e-9);
    EXPECT_TRUE(cheap.equalError->atLeast);
    EXPECT_NEAR(cheap.equalTime->value, 0.5 / 0.004, 1e-9);
    EXPECT_FALSE(cheap.equalTime->atLeast);
    // The reference does not get there: it needs more than its last point.
    const Gain deep = gainAt(std::vector<Cost>{{2, 0.01}, {20, 0.0001}}, kReference, 0.0001);
    EXPECT_NEAR(deep.equalError->value, 50, 1e-9);
    EXPECT_TRUE(deep.equalError->atLeast);
    // Before the reference's first point, whose error can only be larger there.
    const Gain early = gainAt(std::vector<Cost>{{0.5, 0.1}}, kReference, 0.1);
    EXPECT_NEAR(early.equalError->value, 20, 1e-9);
    EXPECT_NEAR(early.equalTime->value, 10, 1e-9);
    EXPECT_TRUE(early.equalTime->atLeast);
}

TEST(Curves, noGainIsMadeUp) {
    const Gain never = gainAt(std::vector<Cost>{{1, 0.5}, {2, 0.4}}, kReference, 0.01);
    EXPECT_FALSE(never.equalError || never.equalTime);
    EXPECT_FALSE(gainAt({}, kReference, 0.01).equalError);
    EXPECT_FALSE(gainAt(kReference, {}, 0.01).equalError);
    // The reference starts below the error: how fast it could have been is not known.
    EXPECT_FALSE(gainAt(std::vector<Cost>{{5, 9}, {6, 2}}, kReference, 3).equalError);
    // After the reference's last point: its error there is not known.
    EXPECT_FALSE(gainAt(std::vector<Cost>{{2000, 0.01}}, kReference, 0.01).equalTime);
}

} // namespace
} // namespace slant
