// What must hold for a reconstruction of fields in which things move.
#include "image/metrics.h"
#include "reconstruct/cpu_reconstructor.h"
#include "support/expect_error.h"
#include "support/intermediates.h"
#include "support/synthetic.h"

#include <numeric>

namespace slant {
namespace {

using synthetic::MovingLayer;
using synthetic::MovingView;

const Rect kFrame{0, 0, 96, 72};
constexpr int kOverscan = 30;
const std::vector<Method> kReconstructions = {Method::full, Method::automatic};

Image reconstruct(const LightField& field, Method method, const LensView& view = {}, int outputs = 128) {
    ReconstructOptions options;
    options.method = method;
    options.outputsPerPixel = outputs;
    options.anyFocus = view.slopeShift != 0;
    CpuReconstructor cpu;
    return test::run(cpu, field, options, view).image;
}

/// The truth, nearly.
Image manySamples(const std::vector<MovingLayer>& layers, MovingView view = {}) {
    view.stands = true;
    return reconstruct(synthetic::sampleMoving(layers, kFrame, 2, 400, 77, view), Method::box);
}

double meanOf(const Image& image) {
    return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) / double(image.pixels.size());
}

struct Case {
    const char* name;
    std::vector<MovingLayer> layers;
    MovingView view;
    double gain; ///< of relMSE over `box`, from 4 samples per pixel
};
const std::vector<Case> kCases = {
    {"lens", synthetic::movingDiscs(), {}, 25},
    {"pinhole", synthetic::movingDiscs(), {.pinhole = true}, 6},
    {"overtaking", synthetic::overtakingDiscs(), {}, 20},
    // All is in focus here, and errors are those of still edges.
    {"overtaking, pinhole", synthetic::overtakingDiscs(), {.pinhole = true}, 2},
};

TEST(MotionStability, isFarBetterThanTheSamples) {
    for (const Case& c : kCases) {
        const Image truth = manySamples(c.layers, c.view);
        const LightField field = synthetic::sampleMoving(c.layers, kFrame, kOverscan, 4, 3, c.view);
        const double box = compare(reconstruct(field, Method::box), truth).relMse;
        for (const Method method : kReconstructions) {
            const Image image = reconstruct(field, method);
            EXPECT_LT(compare(image, truth).relMse * c.gain, box) << c.name << ", " << nameOf(method);
            EXPECT_NEAR(meanOf(image) / meanOf(truth), 1, 0.003) << c.name << ", " << nameOf(method);
        }
    }
}

/// An instant, and a part of the shutter, from the field of the whole one.
TEST(MotionStability, anotherShutter) {
    const LightField field = synthetic::sampleMoving(synthetic::movingDiscs(), kFrame, kOverscan, 8, 3);
    for (const auto& [open, close] :
         {std::pair(0.f, 0.f), {0.3f, 0.3f}, {1.f, 1.f}, {0.f, 0.5f}, {0.4f, 1.f}}) {
        const Image truth = manySamples(synthetic::movingDiscs(), {.open = open, .close = close});
        LensView view;
        view.shutterOpen = open;
        view.shutterClose = close;
        const double whole = compare(reconstruct(field, Method::full), truth).relMse;
        for (const Method method : kReconstructions) {
            const Image image = reconstruct(field, method, view);
            EXPECT_LT(compare(image, truth).relMse, 0.006) << open << " to " << close;
            EXPECT_LT(compare(image, truth).relMse * 5, whole) << open << " to " << close;
            EXPECT_NEAR(meanOf(image) / meanOf(truth), 1, 0.005) << open << " to " << close;
        }
    }
}

TEST(MotionStability, constantRadianceStays) {
    const vec3 colour(0.7f, 1e-3f, 800);
    for (const int spp : {1, 4, 9}) {
        LightField field =
            synthetic::sampleMoving(synthetic::movingDiscs(), {0, 0, 40, 31}, kOverscan, spp, 5);
        synthetic::Random random(9);
        std::ranges::fill(field.radiance, colour);
        for (vec3& m : field.motion)
            m = vec3(60 * random.uniform() - 30, 60 * random.uniform() - 30, 2 * random.uniform() - 1);
        sanitize(field);
        for (const Method method : {Method::box, Method::full, Method::automatic}) {
            const Image image = reconstruct(field, method, {}, 32);
            for (std::size_t i = 0; i < image.pixels.size(); ++i)
                ASSERT_NEAR(image.pixels[i] / colour[int(i % 3)], 1, 1e-5) << spp << ", value " << i;
        }
    }
}

TEST(MotionStability, orderWithinAPixelIsNothing) {
    const LightField field =
        synthetic::sampleMoving(synthetic::movingDiscs(), {0, 0, 40, 31}, kOverscan, 4, 5);
    LightField reversed = field;
    for (std::size_t first = 0; first < field.samples.size(); first += 4) {
        const auto turn = [&](auto& plane) {
            std::reverse(plane.begin() + long(first), plane.begin() + long(first) + 4);
        };
        turn(reversed.samples);
        turn(reversed.radiance);
        turn(reversed.motion);
    }
    for (const Method method : kReconstructions) {
        const Image once = reconstruct(field, method, {}, 32), other = reconstruct(reversed, method, {}, 32);
        for (std::size_t i = 0; i < once.pixels.size(); ++i)
            ASSERT_NEAR(once.pixels[i], other.pixels[i], 1e-4) << nameOf(method) << ", value " << i;
    }
}

/// Errors at the borders of tiles are those inside them.
TEST(MotionStability, tilesHaveNoSeams) {
    const Image truth = manySamples(synthetic::movingDiscs());
    const LightField field = synthetic::sampleMoving(synthetic::movingDiscs(), kFrame, kOverscan, 4, 3);
    for (const Method method : kReconstructions) {
        const Image image = reconstruct(field, method);
        double steps[8] = {}; // between columns, by their place in a tile
        for (int y = 0; y < kFrame.y1; ++y)
            for (int x = 1; x < kFrame.x1; ++x) {
                const auto error = [&](int column) {
                    return image.at(column, y, 0) - truth.at(column, y, 0);
                };
                steps[x % 8] += std::abs(double(error(x) - error(x - 1)));
            }
        // Regions begin a pixel before the frame: their tiles end at 7, 15, ...
        const double mean = std::accumulate(steps, steps + 8, 0.0) / 8;
        for (const double step : steps) EXPECT_LT(step, 1.35 * mean) << nameOf(method);
    }
}

/// A field that moves as a whole, seen at an instant, is the still one.
TEST(MotionStability, whatMovesAlikeStaysSharp) {
    std::vector<MovingLayer> layers = synthetic::movingDiscs();
    for (MovingLayer& layer : layers) layer.motion = {40, -25, 0};
    LensView middle;
    middle.shutterOpen = middle.shutterClose = 0.5f;
    const Image truth = manySamples(layers, {.open = 0.5f, .close = 0.5f});
    const LightField moving = synthetic::sampleMoving(layers, kFrame, 40, 8, 3);
    const LightField still =
        synthetic::sampleMoving(layers, kFrame, 40, 8, 3, {.open = 0.5f, .close = 0.5f, .stands = true});
    const double best = compare(reconstruct(still, Method::full), truth).relMse;
    for (const Method method : kReconstructions)
        EXPECT_LT(compare(reconstruct(moving, method, middle), truth).relMse, 2 * best + 1e-4);
}

TEST(MotionStability, methodsThatLookInTheirOwnPixelsKeepTheShutter) {
    const LightField field = synthetic::sampleMoving(synthetic::movingDiscs(), {0, 0, 20, 10}, 5, 1, 3);
    LensView view;
    view.shutterClose = 0.5f;
    test::expectError(ErrorCode::usage, "traced shutter only",
                      [&] { reconstruct(field, Method::box, view); });
    test::expectError(ErrorCode::usage, "another time moves",
                      [&] { reconstruct(field, Method::window, view); });
}

} // namespace
} // namespace slant
