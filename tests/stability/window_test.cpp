// The method `window` against its description, carried out in double precision, and where it fails.
#include "lib/gaussian.glsl"
#include "reconstruct/cpu_reconstructor.h"
#include "reconstruct/window.h"
#include "support/intermediates.h"
#include "support/synthetic.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace slant {
namespace {

struct Point {
    double x, y; ///< from the output
    double slope;
    glm::dvec3 rgb;
};

using Points = std::vector<Point>;

/// Samples of the window that reproject to within the radius, front to back.
Points pointsAround(const LightField& field, const WindowSearch& search, ivec2 pixel, const Output& o) {
    const float radiusPx = 2 * (1 / std::sqrt(float(field.samplesPerPixel)));
    Points points;
    for (int y = field.bounds.y0; y < field.bounds.y1; ++y)
        for (int x = field.bounds.x0; x < field.bounds.x1; ++x) {
            if (std::abs(x - pixel.x) > search.rangePx || std::abs(y - pixel.y) > search.rangePx) continue;
            for (int k = 0; k < field.samplesPerPixel; ++k) {
                const std::size_t place =
                    std::size_t((y - field.bounds.y0) * field.bounds.width() + (x - field.bounds.x0));
                const std::size_t sample = place * std::size_t(field.samplesPerPixel) + std::size_t(k);
                const LightFieldSample& s = field.samples[sample];
                const Point p{s.x + (double(o.uv.x) - s.u) * s.slope - o.xy.x,
                              s.y + (double(o.uv.y) - s.v) * s.slope - o.xy.y, s.slope,
                              glm::dvec3(field.radiance[sample])};
                if (std::hypot(p.x, p.y) < radiusPx) points.push_back(p);
            }
        }
    std::stable_sort(points.begin(), points.end(), [](auto& a, auto& b) { return a.slope < b.slope; });
    return points;
}

bool crossing(const Point& a, const Point& b, double step) {
    const auto order = [&](double da, double db) { return a.x + da * a.slope > b.x + db * b.slope; };
    const auto orderY = [&](double da, double db) { return a.y + da * a.slope > b.y + db * b.slope; };
    return order(step, step) != order(-step, -step) || orderY(step, step) != orderY(-step, -step);
}

/// Whether a triangle of the points contains the output.
bool covers(const Points& s) {
    const auto left = [](const Point& a, const Point& b) { return a.x * b.y - a.y * b.x > 0; };
    for (std::size_t a = 0; a < s.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            for (std::size_t c = 0; c < b; ++c)
                if (left(s[a], s[b]) == left(s[b], s[c]) && left(s[b], s[c]) == left(s[c], s[a])) return true;
    return false;
}

glm::dvec3 expected(const LightField& field, const WindowSearch& search, ivec2 pixel, const Output& o) {
    std::vector<Points> surfaces;
    for (const Point& point : pointsAround(field, search, pixel, o)) {
        if (surfaces.empty() ||
            (surfaces.back().size() >= 3 && crossing(surfaces.back().back(), point, search.lensStep)))
            surfaces.emplace_back();
        surfaces.back().push_back(point);
    }
    if (surfaces.empty()) return glm::dvec3(0);
    const auto covering = std::find_if(surfaces.begin(), surfaces.end(), covers);
    const Points& surface = covering == surfaces.end() ? surfaces.front() : *covering;
    glm::dvec3 sum(0);
    double weights = 0;
    for (const Point& p : surface) {
        const double weight = std::exp(-std::min(search.alpha * (p.x * p.x + p.y * p.y), 40.0));
        sum += weight * p.rgb;
        weights += weight;
    }
    return sum / weights;
}

TEST(Window, equalsItsDescriptionInDoublePrecision) {
    for (const auto& [spp, options] : {std::pair(4, WindowOptions{}),
                                       {1, {.rangePx = 9, .alpha = 0.7f}},
                                       {9, {.rangePx = 6, .alpha = 8, .lensStep = 0.05f}}}) {
        const LightField field = synthetic::sample(synthetic::discsOverChecks(), {0, 0, 40, 30}, 15, spp, 3);
        const WindowSamples samples = windowSamples(SceneSideSamples(field), ValuePlane::radiance);
        const WindowSearch search = windowSearch(field, options);
        const OutputPattern pattern = makeOutputPattern(2, 0);
        std::vector<WindowCandidate> scratch;
        int outputs = 0, different = 0, parted = 0, holes = 0;
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x)
                for (int k = 0; k < 2; ++k) {
                    const Output o = outputAt({x, y}, k, pattern, 0);
                    const WindowResult got = lookThroughWindow(samples, search, {x, y}, o, scratch);
                    const glm::dvec3 apart =
                        glm::abs(glm::dvec3(got.rgb) - expected(field, search, {x, y}, o));
                    ++outputs;
                    different += std::max({apart.x, apart.y, apart.z}) > 2e-4;
                    parted += got.outcome == WindowOutcome::parted;
                    holes += got.outcome == WindowOutcome::hole;
                }
        // Where rounding decides a comparison, an output may differ completely.
        EXPECT_LE(different, outputs / 500) << spp;
        EXPECT_GT(parted, outputs / 20) << spp;
        EXPECT_GT(holes, 0) << spp;
    }
}

TEST(Window, exponentialIsExactToThreeUlp) {
    for (int i = 0; i <= 100000; ++i) {
        const float x = 80 * float(i) / 100000;
        const double exact = std::exp(-double(x));
        ASSERT_NEAR(expOfMinus(x) / exact, 1, 3 * 0x1p-23) << x;
    }
    EXPECT_EQ(expOfMinus(0), 1);
}

/// One plane of that slope and of brightness 1 everywhere.
LightField plane(float slope, int spp) {
    return synthetic::sample(
        {{slope, [](glm::vec2) { return true; }, [](glm::vec2) { return glm::vec3(1); }}}, {0, 0, 40, 30}, 20,
        spp, 5);
}

test::Reconstruction reconstruct(const LightField& field, Method method, bool fill = false) {
    ReconstructOptions options;
    options.method = method;
    options.outputsPerPixel = 32;
    options.window.fill = fill;
    CpuReconstructor cpu;
    return test::run(cpu, field, options);
}

double meanOf(const Image& image) {
    return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) / double(image.pixels.size());
}

TEST(Window, blurThatOutrunsItLeavesBlackHoles) {
    for (const int spp : {4, 16}) {
        const auto within = reconstruct(plane(1.5f, spp), Method::window);
        EXPECT_EQ(within.report.search.holes, 0u);
        EXPECT_NEAR(meanOf(within.image), 1, 1e-5);

        const LightField blurred = plane(14, spp);
        const auto window = reconstruct(blurred, Method::window);
        EXPECT_GT(window.report.search.holes, window.report.outputs / 10);
        EXPECT_NEAR(meanOf(window.image),
                    1 - double(window.report.search.holes) / double(window.report.outputs), 0.02);
        const auto filled = reconstruct(blurred, Method::window, true);
        EXPECT_EQ(filled.report.search.holes, 0u);
        EXPECT_EQ(filled.report.search.widened, window.report.search.holes);
        EXPECT_NEAR(meanOf(filled.image), 1, 1e-5);
        const auto full = reconstruct(blurred, Method::full);
        EXPECT_EQ(full.report.search.holes, 0u);
        EXPECT_NEAR(meanOf(full.image), 1, 1e-5);
    }
}

TEST(Window, brightnessDoesNotDependOnTheNumberOfSamples) {
    for (const int spp : {1, 4, 16, 64})
        EXPECT_NEAR(meanOf(reconstruct(plane(0.5f, spp), Method::window).image), 1, 1e-5) << spp;
}

} // namespace
} // namespace slant
