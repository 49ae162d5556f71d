// The device against the CPU, to the bit, on cases drawn at random: scenes or layers, sizes, samples,
// methods, filters, lenses, views, budgets. One number is one case:
//
//     SLANT_RANDOM_CASES=1234 build/release/tests/slant_parity_tests --gtest_filter='RandomParity.*'
//     SLANT_RANDOM_CASES=0,10000 ...                          from 0, 10000 of them
#include "base/error.h"
#include "render/render.h"
#include "support/random_field.h"
#include "support/random_scene.h"
#include "support/scene_text.h"
#include "trace/tracer.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>

namespace slant {
namespace {

constexpr int kFewCases = 60; ///< for every run of the tests
constexpr double kMostOutputs = 4e6, kUsuallyMostOutputs = 3e5;

using test::Draw;

struct RandomCase {
    std::string scene; ///< empty: layers
    SampleOptions sampling;
    LightField field;
    ReconstructOptions options;
    LensView view;
    bool auxiliary = false;

    std::string text() const {
        return fmt::format(
            "{}method {}, {} samples, {} outputs, {}x{} pixels, seed {}, {} bytes, focus by {}, "
            "aperture {} times, shutter {} to {}",
            scene, nameOf(options.method), field.samples.size(), options.outputsPerPixel, field.frame.width(),
            field.frame.height(), options.seed, options.memoryBytes, view.slopeShift, view.apertureScale,
            view.shutterOpen, view.shutterClose);
    }
};

void traceScene(RandomCase& drawn, Draw& draw) {
    drawn.scene = test::RandomScene(draw).text();
    SilentMonitor monitor;
    const Scene scene = test::sceneOf(drawn.scene);
    drawn.options.filter = scene.filter;
    drawn.sampling.samplesPerPixel = 1 + draw.below(draw.chance(0.2f) ? 33 : 8);
    drawn.sampling.seed = draw.random.bits();
    drawn.sampling.planes.albedo = drawn.auxiliary;
    if (draw.chance(0.7f)) drawn.sampling.planes.shading = drawn.sampling.planes.shadows = true;
    drawn.field = traceField(Tracer(scene, monitor), scene, drawn.sampling, monitor).field;
}

void drawView(RandomCase& drawn, Draw& draw) {
    const MethodTraits& traits = traitsOf(drawn.options.method);
    if (traits.makesOutputs() && draw.chance(0.3f)) {
        constexpr float kScales[] = {0, 0.37f, 1, 1.5f};
        drawn.view.apertureScale = kScales[draw.below(4)];
        constexpr const char* kShapes[] = {"disc", "gaussian", "star", "polygon 5 10"};
        drawn.view.aperture = Aperture(*parseAperture(kShapes[draw.below(4)], {}));
    }
    if (!traits.refocuses()) return;
    if (draw.chance(0.3f)) {
        drawn.options.anyFocus = true;
        drawn.view.slopeShift = draw.chance(0.2f) ? draw(-300, 300) : draw(-8, 8);
    }
    if (draw.chance(0.2f)) {
        drawn.view.shutterOpen = draw(0, 1);
        drawn.view.shutterClose =
            draw.chance(0.4f) ? drawn.view.shutterOpen : draw(drawn.view.shutterOpen, 1);
    }
}

RandomCase caseOf(int number) {
    Draw draw{synthetic::Random(std::uint32_t(number))};
    RandomCase drawn;
    ReconstructOptions& options = drawn.options;
    options.method = draw.chance(0.4f) ? Method::automatic : Method(draw.below(kMethodCount));
    options.window = {draw.below(6), std::exp(draw(-2, 8)), {}, draw.chance(0.5f)};
    if (draw.chance(0.3f)) options.window.lensStep = draw(0, 2);
    options.seed = draw.random.bits();
    options.memoryBytes = draw.chance(0.5f) ? std::uint64_t(std::exp2(draw(20, 30))) : 1 << 30;
    drawn.auxiliary = draw.chance(0.2f);

    if (draw.chance(0.6f))
        traceScene(drawn, draw);
    else
        drawn.field = test::randomLayers(draw);
    LightField& field = drawn.field;
    if (field.lensMap.empty() && draw.chance(0.3f)) test::thinOut(field, draw);
    if (draw.chance(0.1f)) test::spoil(field, draw);
    sanitize(field);
    drawView(drawn, draw);
    // Where a small frame has much around it, each output has many samples to choose from.
    const double work = std::max(double(field.frame.area()), double(field.samples.size()) / 20);
    const double most = draw.chance(0.05f) ? kMostOutputs : kUsuallyMostOutputs;
    options.outputsPerPixel = 1 << draw.below(1 + std::clamp(int(std::log2(most / work)), 0, 8));
    return drawn;
}

enum class Outcome { equal, overBudget };

/// Throws Error(outOfBounds) for the first intermediate that differs.
Outcome compare(const RandomCase& drawn, Backend& backend) {
    SilentMonitor monitor;
    ReconstructReport report;
    try {
        FieldPictures pictures(backend, drawn.field, drawn.options, true);
        Image image = pictures.colours(drawn.view, monitor, report);
        if (drawn.auxiliary) pictures.addAuxiliary(image, drawn.view, monitor, report);
        EXPECT_TRUE(std::ranges::all_of(image.pixels, [](float value) { return std::isfinite(value); }));
        return Outcome::equal;
    } catch (const Error& error) {
        if (error.code() != ErrorCode::resources ||
            std::string(error.what()).find("memory budget") == std::string::npos)
            throw;
    }
    try { // what the CPU refused, the device refuses, too
        FieldPictures(backend, drawn.field, drawn.options).colours(drawn.view, monitor, report);
        ADD_FAILURE() << "only the CPU found the memory budget too small";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::resources) << error.what();
    }
    return Outcome::overBudget;
}

/// First and number of the cases that the environment asks for.
std::pair<int, int> wantedCases() {
    const char* text = std::getenv("SLANT_RANDOM_CASES");
    if (!text) return {0, kFewCases};
    int first = 0, count = 1;
    if (std::sscanf(text, "%d,%d", &first, &count) < 1)
        throw std::runtime_error("SLANT_RANDOM_CASES: FIRST,COUNT");
    return {first, count};
}

TEST(RandomParity, deviceEqualsCpu) {
    const char* without = std::getenv("SLANT_TESTS_WITHOUT_VULKAN");
    if (without && std::string_view(without) == "1") GTEST_SKIP() << "SLANT_TESTS_WITHOUT_VULKAN";
    Backend backend("auto");
    const auto [first, count] = wantedCases();
    int equal = 0, overBudget = 0;
    for (int number = first; number < first + count; ++number) {
        SCOPED_TRACE(fmt::format("SLANT_RANDOM_CASES={}", number));
        fmt::print("{} ", number);
        std::fflush(stdout); // before anything that may crash or hang
        RandomCase drawn;
        try {
            drawn = caseOf(number);
            if (count == 1) fmt::print("{}\n", drawn.text());
            std::fflush(stdout);
            ++(compare(drawn, backend) == Outcome::equal ? equal : overBudget);
        } catch (const std::exception& error) {
            ADD_FAILURE() << error.what() << "\n" << drawn.text();
        }
    }
    fmt::print("\n{} cases: {} equal, {} over their memory budgets\n", count, equal, overBudget);
    EXPECT_EQ(equal + overBudget, count);
    EXPECT_LE(overBudget, 1 + count / 4) << "cases that test nothing";
}

} // namespace
} // namespace slant
