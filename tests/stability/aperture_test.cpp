// Blur has the shape of the aperture, whichever method makes it.
#include "image/metrics.h"
#include "reconstruct/cpu_reconstructor.h"
#include "support/intermediates.h"
#include "support/synthetic.h"

namespace slant {
namespace {

const Rect kFrame{0, 0, 48, 48};
constexpr float kSlopePx = 14, kLampPx = 3;

/// A small lamp far behind the plane in focus, before a grey wall.
LightField lamp(int spp, std::uint32_t seed, const Aperture& aperture) {
    const auto grey = [](glm::vec2) { return glm::vec3(0.05f); };
    return synthetic::sample({{kSlopePx, [](glm::vec2 p) { return glm::length(p - 24.f) < kLampPx; },
                               [](glm::vec2) { return glm::vec3(60); }},
                              {kSlopePx + 5, [](glm::vec2) { return true; }, grey}},
                             kFrame, 24, spp, seed, aperture);
}

Image reconstruct(const LightField& field, Method method,
                  const std::optional<Aperture>& aperture = std::nullopt) {
    ReconstructOptions options;
    options.method = method;
    options.outputsPerPixel = 128;
    CpuReconstructor cpu;
    return test::run(cpu, field, options, {.aperture = aperture}).image;
}

Aperture shapeOf(const char* name) {
    return Aperture(*parseAperture(name, {}));
}

/// The share of the lamp's light that is not where the aperture, as wide as its blur, would have it.
double differenceOfShapes(const Image& image, const Aperture& aperture) {
    constexpr int kFine = 12; // parts of a pixel and the lamp on it, along a side
    std::vector<double> light, expected;
    double lightSum = 0, expectedSum = 0;
    for (int y = kFrame.y0; y < kFrame.y1; ++y)
        for (int x = kFrame.x0; x < kFrame.x1; ++x) {
            double open = 0;
            for (int k = 0; k < kFine * kFine; ++k) {
                const glm::vec2 offset = (glm::vec2(k % kFine, k / kFine) + 0.5f) * (2.f / kFine) - 1.f;
                if (glm::length(offset) > 1) continue;
                open += double(
                    aperture.transmission((glm::vec2(x, y) + 0.5f - 24.f + offset * (kLampPx)) / kSlopePx));
            }
            light.push_back(double(image.at(x, y, 0)) - 0.05);
            expected.push_back(open);
            lightSum += light.back();
            expectedSum += open;
        }
    double difference = 0;
    for (std::size_t i = 0; i < light.size(); ++i)
        difference += std::abs(light[i] / lightSum - expected[i] / expectedSum) / 2;
    return difference;
}

class LampThrough : public testing::TestWithParam<const char*> {};

TEST_P(LampThrough, theApertureIsItsShape) {
    const Aperture aperture = shapeOf(GetParam());
    const Image truth = reconstruct(lamp(400, 77, aperture), Method::box);
    EXPECT_LT(differenceOfShapes(truth, aperture), 0.08);
    EXPECT_GT(differenceOfShapes(truth, Aperture()), 0.16);
    const double filtered = compare(reconstruct(lamp(8, 1, aperture), Method::box), truth).relMse;
    for (const Method method : {Method::full, Method::automatic}) {
        const Image traced = reconstruct(lamp(8, 1, aperture), method);
        const Image narrowed = reconstruct(lamp(8, 1, Aperture()), method, aperture);
        EXPECT_LT(compare(traced, truth).relMse, 0.25 * filtered) << nameOf(method);
        EXPECT_LT(compare(narrowed, truth).relMse, 0.25 * filtered) << nameOf(method);
    }
    // Another shape gives another picture.
    EXPECT_GT(compare(reconstruct(lamp(8, 1, aperture), Method::full, Aperture()), truth).relMse,
              0.4 * filtered);
}

INSTANTIATE_TEST_SUITE_P(Shapes, LampThrough, testing::Values("square", "star", "pentagon", "gaussian"));

} // namespace
} // namespace slant
