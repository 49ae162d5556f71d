// The table of the pixel filter against formulas and integrals in double precision.
#include "reconstruct/filter_table.h"

#include "support/expect_error.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace slant {
namespace {

/// One axis of a filter, and its integral over [-radius, radius] where it has a closed form.
struct Known {
    PixelFilter filter;
    std::function<double(double)> value;
    double integral;
};

double cubic(double a, double b, double c, double d, double x) {
    return ((a * x + b) * x + c) * x + d;
}

/// Mitchell and Netravali's filter with B = C = 1/3, support [-2, 2].
double mitchell(double x) {
    x = std::abs(x);
    if (x < 1) return cubic(7 / 6.0, -2, 0, 8 / 9.0, x);
    return x < 2 ? cubic(-7 / 18.0, 2, -10 / 3.0, 16 / 9.0, x) : 0;
}

double lanczos(double x, double tau) {
    const double p = std::numbers::pi * x;
    return x == 0 ? 1 : std::sin(p) / p * std::sin(p / tau) / (p / tau);
}

double simpson(const std::function<double(double)>& f, double a, double b) {
    constexpr int kSteps = 4000;
    const double h = (b - a) / kSteps;
    double sum = f(a) + f(b);
    for (int i = 1; i < kSteps; ++i) sum += f(a + i * h) * (i % 2 ? 4 : 2);
    return sum * h / 3;
}

std::vector<Known> knownFilters() {
    const double sigma = 0.5, normal = 1 / (sigma * std::sqrt(2 * std::numbers::pi));
    const double edge = normal * std::exp(-4.5);
    return {
        {{FilterKind::box, {0.5f, 0.5f}}, [](double) { return 1.0; }, 1},
        {{FilterKind::triangle, {2, 2}}, [](double x) { return 2 - x; }, 4},
        {{FilterKind::gaussian, {1.5f, 1.5f}},
         [=](double x) { return normal * std::exp(-2 * x * x) - edge; },
         std::erf(3 / std::sqrt(2.0)) - 3 * edge},
        {{FilterKind::mitchell, {2, 2}}, mitchell, 1},
        {{FilterKind::mitchell, {3, 3}}, [](double x) { return mitchell(2 * x / 3); }, 1.5},
        {{FilterKind::sinc, {4, 4}},
         [](double x) { return lanczos(x, 3); },
         2 * simpson([](double x) { return lanczos(x, 3); }, 0, 4)},
    };
}

TEST(FilterTable, weightsAreTheFilterAtTheMiddleOfEachStep) {
    for (const Known& known : knownFilters()) {
        const FilterTable table = makeFilterTable(known.filter);
        ASSERT_EQ(table.length.x, int(known.filter.radius.x * kSubpixels));
        ASSERT_EQ(table.weights.size(),
                  std::size_t(table.length.x + table.length.y + 2 * (table.reach.x + 1)));
        for (int i = 0; i < table.length.x; ++i) {
            const double exact = known.value((i + 0.5) / kSubpixels);
            ASSERT_NEAR(table.weights[std::size_t(i)], exact, 1e-7 * std::max(1.0, std::abs(exact)))
                << int(known.filter.kind) << " at " << i;
            ASSERT_EQ(table.weights[std::size_t(i)], table.weights[std::size_t(i + table.length.x)]);
        }
    }
}

TEST(FilterTable, massIsTheIntegral) {
    for (const Known& known : knownFilters()) {
        const FilterTable table = makeFilterTable(known.filter);
        const double half =
            std::accumulate(table.weights.begin(), table.weights.begin() + table.length.x, 0.0) / kSubpixels;
        EXPECT_NEAR(2 * half, known.integral, 1e-6) << int(known.filter.kind);
    }
}

/// A sample that stands for a whole pixel has the mean weight of samples all over that pixel.
TEST(FilterTable, meansOverPixelsAddUpToTheIntegral) {
    for (const Known& known : knownFilters()) {
        const FilterTable table = makeFilterTable(known.filter);
        const float* means = table.weights.data() + table.length.x + table.length.y;
        double sum = means[0];
        for (int offset = 1; offset <= table.reach.x; ++offset) {
            sum += 2 * means[offset];
            const auto value = [&](double x) { return x < known.filter.radius.x ? known.value(x) : 0; };
            EXPECT_NEAR(means[offset], simpson(value, offset - 0.5, offset + 0.5), 1e-4)
                << int(known.filter.kind);
        }
        EXPECT_NEAR(sum, known.integral, 1e-5) << int(known.filter.kind);
    }
}

TEST(FilterTable, axesHaveTheirOwnRadii) {
    const FilterTable table = makeFilterTable({FilterKind::triangle, {0.25f, 3.1f}});
    EXPECT_EQ(table.length, ivec2(1024, 12698));
    EXPECT_EQ(table.reach, ivec2(0, 3));
    EXPECT_NEAR(table.weights[0], 0.25 - 0.5 / kSubpixels, 1e-7);
    EXPECT_NEAR(table.weights[1024], 3.1 - 0.5 / kSubpixels, 1e-6);
}

TEST(FilterTable, impossibleRadiiAreRefused) {
    for (const float radius : {0.f, -1.f, 16.01f, std::numeric_limits<float>::quiet_NaN()})
        test::expectError(ErrorCode::badInput, "radius", [&] {
            makeFilterTable({FilterKind::box, {0.5f, radius}});
        });
}

} // namespace
} // namespace slant
