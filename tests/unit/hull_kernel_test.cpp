// The hull of lib/candidate.glsl against all triangles of the points.
#include "lib/candidate.glsl"
#include "support/brute_force.h"
#include "support/synthetic.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

using Points = std::vector<vec2>;

bool surrounded(const Points& points) {
    Hull hull = noHull();
    for (const vec2 p : points) addPoint(hull, p);
    return surrounds(hull);
}

/// Whether a triangle of the points has the origin inside. Products of floats are exact in double precision,
/// and so are the signs of their differences.
bool heldByATriangle(const Points& points) {
    const auto left = [](glm::dvec2 a, glm::dvec2 b) {
        const double ab = a.x * b.y, ba = a.y * b.x;
        return int(ab > ba) - int(ab < ba);
    };
    for (std::size_t a = 0; a < points.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            for (std::size_t c = 0; c < b; ++c) {
                const int side = left(points[a], points[b]);
                if (side != 0 && side == left(points[b], points[c]) && side == left(points[c], points[a]))
                    return true;
            }
    return false;
}

/// Whether the origin lies in a point or between two, and so maybe on an edge of the hull, where neither
/// answer is wrong.
bool onTheRim(const Points& points) {
    for (const vec2 p : points)
        if (p == vec2(0)) return true;
    for (const vec2 a : points)
        for (const vec2 b : points)
            if (double(a.x) * b.y == double(a.y) * b.x && glm::dot(a, b) < 0) return true;
    return false;
}

float between(synthetic::Random& random, float low, float high) {
    return low + (high - low) * random.uniform();
}

TEST(Hull, surroundsWhatATriangleHolds) {
    synthetic::Random random(1);
    int held = 0, rounds = 0;
    for (int count = 0; count <= 14; ++count)
        for (int i = 0; i < 2000; ++i, ++rounds) {
            // Around places off the output, so that about half of the hulls contain it.
            const vec2 middle(between(random, -1, 1), between(random, -1, 1));
            Points points;
            for (int k = 0; k < count; ++k)
                points.push_back(middle + vec2(between(random, -1, 1), between(random, -1, 1)));
            const bool expected = heldByATriangle(points);
            ASSERT_EQ(surrounded(points), expected) << count << " points, round " << i;
            held += expected;
        }
    EXPECT_GT(held, rounds / 4);
    EXPECT_LT(held, rounds * 3 / 4);
}

/// Small whole numbers: many points lie on axes, on lines through the output, or on each other.
TEST(Hull, surroundsWhatATriangleHoldsOnAGridToo) {
    synthetic::Random random(2);
    int held = 0, rims = 0;
    for (int i = 0; i < 40000; ++i) {
        Points points;
        const int count = 1 + int(random.bits() % 8), span = 1 + int(random.bits() % 3);
        const auto coordinate = [&] { return float(int(random.bits() % uint(2 * span + 1)) - span); };
        for (int k = 0; k < count; ++k) {
            const float x = coordinate();
            points.push_back({x, coordinate()});
        }
        std::erase(points, vec2(0));
        const bool expected = heldByATriangle(points);
        if (!expected && onTheRim(points)) {
            ++rims;
            continue;
        }
        held += expected;
        ASSERT_EQ(surrounded(points), expected) << i;
    }
    EXPECT_GT(held, 5000);
    EXPECT_GT(rims, 1000);
}

TEST(Hull, ofPointsOnBothAxesHoldsTheirCrossing) {
    EXPECT_TRUE(surrounded({{1, 0}, {-2, 0}, {0, 3}, {0, -1}}));
    EXPECT_FALSE(surrounded({{1, 0}, {0, 3}, {0, -1}})) << "on its rim";
    EXPECT_FALSE(surrounded({{1, 0}, {0, 3}}));
    EXPECT_FALSE(surrounded({{-1, 0}, {-2, 0}, {-1, -1}, {-1, 1}}));
    EXPECT_TRUE(surrounded({{-1, 0}, {1, 1}, {1, -1}}));
    EXPECT_TRUE(surrounded({{1, 0}, {-1, 1}, {-1, -1}}));
    EXPECT_TRUE(surrounded({{0, 1}, {1, -1}, {-1, -1}}));
    EXPECT_TRUE(surrounded({{0, -1}, {1, 1}, {-1, 1}}));
}

TEST(Hull, ofOneOrTwoPlacesHoldsNothing) {
    EXPECT_FALSE(surrounded({}));
    synthetic::Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const vec2 a(between(random, -1, 1), between(random, -1, 1));
        const vec2 b(between(random, -1, 1), between(random, -1, 1));
        ASSERT_FALSE(surrounded({a, a, a}));
        ASSERT_FALSE(surrounded({a, b, a, b, b}));
    }
}

TEST(Hull, doesNotChangeWithCopiesOrOrder) {
    synthetic::Random random(4);
    for (int i = 0; i < 3000; ++i) {
        Points points;
        for (int k = 0; k < 4; ++k) points.push_back({between(random, -1, 1), between(random, -1, 1)});
        const bool once = surrounded(points);
        std::reverse(points.begin(), points.end());
        ASSERT_EQ(surrounded(points), once);
        for (int k = 0; k < 3; ++k) points.push_back(vec2(points[std::size_t(k)]));
        ASSERT_EQ(surrounded(points), once);
        for (vec2& p : points) p *= 0x1p-20f;
        ASSERT_EQ(surrounded(points), once);
    }
}

TEST(Hull, bruteForceByAnglesSaysTheSame) {
    synthetic::Random random(5);
    for (int i = 0; i < 20000; ++i) {
        Points points;
        std::vector<glm::dvec2> exact;
        const vec2 middle(between(random, -1, 1), between(random, -1, 1));
        for (uint k = 0; k < 3 + random.bits() % 10; ++k) {
            points.push_back(middle + vec2(between(random, -1, 1), between(random, -1, 1)));
            exact.push_back(points.back());
        }
        ASSERT_EQ(test::surroundOrigin(exact), heldByATriangle(points)) << i;
    }
}

} // namespace
} // namespace slant
