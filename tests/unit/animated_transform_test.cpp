// Interpolated transforms against rotations by part of an angle, worked out one by one.
#include "scene/animated_transform.h"
#include "scene/transforms.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <random>

namespace slant {
namespace {

glm::dmat4 shifted(glm::dvec3 by) {
    return glm::translate(glm::dmat4(1), by);
}

glm::dmat4 scaled(glm::dvec3 by) {
    return glm::scale(glm::dmat4(1), by);
}

double difference(const glm::dmat4& a, const glm::dmat4& b) {
    double most = 0;
    for (int column = 0; column < 4; ++column) most = std::max(most, glm::length(a[column] - b[column]));
    return most;
}

TEST(AnimatedTransform, turnsByPartOfTheAngleAndMovesAndStretchesEvenly) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const auto vector = [&] { return glm::dvec3(normal(random), normal(random), normal(random)); };
    const glm::dvec3 signs[] = {{1, 1, 1}, {-1, 1, 1}, {-1, -1, -1}, {1, 1, -1}};
    for (int i = 0; i < 400; ++i) {
        const glm::dvec3 axis = vector(), from = vector(), to = vector();
        const double start = 90 * normal(random), turn = 179 * std::tanh(normal(random));
        const bool even = i % 3 == 0;
        const glm::dvec3 small = even ? glm::dvec3(0.7) : glm::abs(vector()) + 0.01,
                         large = even ? glm::dvec3(2) : glm::abs(vector()) + 0.01, sign = signs[i % 4];
        const auto truth = [&](double part) {
            return shifted(glm::mix(from, to, part)) * rotation(start + part * turn, axis) *
                   scaled(sign * glm::mix(small, large, part));
        };
        const MovingTransform ends{{truth(0), truth(1)}, {0.25, 0.75}};
        ASSERT_TRUE(canInterpolate(ends));
        const AnimatedTransform moving(ends);
        for (const double part : {0.1, 0.5, 0.75})
            EXPECT_LT(difference(moving.at(0.25 + 0.5 * part), truth(part)), 1e-10) << i << " " << part;
        // To the bit at the ends and beyond.
        for (const double before : {0.0, 0.25}) EXPECT_EQ(moving.at(before), ends.at[0]);
        for (const double after : {0.75, 1.0}) EXPECT_EQ(moving.at(after), ends.at[1]);
        EXPECT_LT(difference(moving.at(0.25 + 1e-9), ends.at[0]), 1e-7);
    }
}

TEST(AnimatedTransform, goesTheShortWayRound) {
    const glm::dvec3 axis(0, 0, 1);
    const auto halfWay = [&](double degrees) {
        return AnimatedTransform(MovingTransform{{glm::dmat4(1), rotation(degrees, axis)}}).at(0.5);
    };
    EXPECT_LT(difference(halfWay(270), rotation(-45, axis)), 1e-12);
    // Half a turn goes either way.
    EXPECT_LT(
        std::min(difference(halfWay(180), rotation(90, axis)), difference(halfWay(180), rotation(-90, axis))),
        1e-12);
    // A full turn is none.
    EXPECT_LT(difference(halfWay(360), glm::dmat4(1)), 1e-12);
}

TEST(AnimatedTransform, keepsShearedAndTinyMatricesInvertible) {
    glm::dmat4 sheared(1);
    sheared[1].x = 20;
    const MovingTransform ends{{scaled(glm::dvec3(1e-6)) * sheared, rotation(150, {1, 2, 3}) * sheared}};
    const AnimatedTransform moving(ends);
    for (int i = 0; i <= 100; ++i) EXPECT_GT(glm::determinant(glm::dmat3(moving.at(i / 100.0))), 1e-20) << i;
}

TEST(AnimatedTransform, knowsWhatItCannotDo) {
    EXPECT_FALSE(canInterpolate({{glm::dmat4(1), scaled({1, -1, 1})}}));
    EXPECT_TRUE(canInterpolate({{scaled({1, 1, -1}), scaled({1, -1, 1})}}));
    EXPECT_TRUE(canInterpolate({{glm::dmat4(1), scaled({-1, -1, 1})}}));
}

TEST(AnimatedTransform, keepsTheBitsOfWhatStandsStill) {
    const glm::dmat4 odd = shifted({0.1, 0.2, 0.3}) * rotation(33, {1, 2, 3}) * scaled({0.3, 0.7, 1.1});
    const AnimatedTransform still(MovingTransform{{odd, odd}});
    EXPECT_FALSE(still.moves());
    EXPECT_EQ(still.at(0.37), odd);
}

TEST(AnimatedTransform, seesThePartOfTheMotionThatTheShutterSees) {
    const MovingTransform move{{glm::dmat4(1), shifted({1, 0, 0})}};
    const auto placeAt = [&](std::array<double, 2> times, double open, double close, double time) {
        return AnimatedTransform(overShutter(move, times, open, close)).at(time)[3].x;
    };
    EXPECT_DOUBLE_EQ(placeAt({0, 1}, 0, 0.5, 1), 0.5);
    EXPECT_DOUBLE_EQ(placeAt({0, 1}, 0.25, 0.75, 0), 0.25);
    EXPECT_DOUBLE_EQ(placeAt({1, 3}, 0, 2, 0.75), 0.25);
    EXPECT_DOUBLE_EQ(placeAt({1, 3}, 0, 2, 0.25), 0);
    // Nothing moves while it is open.
    EXPECT_EQ(placeAt({0, 1}, 1, 2, 0.5), 1);
    EXPECT_FALSE(overShutter(move, {0, 1}, 1, 2).moves());
    EXPECT_EQ(placeAt({1, 2}, 0, 1, 0.5), 0);
    EXPECT_FALSE(overShutter(move, {1, 2}, 0, 1).moves());
    EXPECT_TRUE(overShutter(move, {-1, 0.1}, 0, 1).moves());
}

} // namespace
} // namespace slant
