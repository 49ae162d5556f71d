// Options of other views: which pictures they ask for.
#include "commands/view_options.h"

#include <gtest/gtest.h>

namespace slant::commands {
namespace {

ViewOptions parsed(const std::string& words) {
    CLI::App app;
    ViewOptions options;
    addViewOptions(app, options);
    app.parse(words);
    checkViewOptions(options, Method::automatic);
    return options;
}

TEST(ViewOptions, withoutAnyThePictureIsThatOfTheTracedLensAndShutter) {
    const std::vector<ViewStep> steps = viewSteps(parsed(""));
    ASSERT_EQ(steps.size(), 1u);
    EXPECT_FALSE(steps[0].focusDistance);
    EXPECT_TRUE(steps[0].shutter.isTraced());
    EXPECT_FALSE(parsed("--shutter 0,1").changesTime());
}

TEST(ViewOptions, shuttersAndInstantsStayAlongAFocusPull) {
    for (const auto& [words, open, close] : {std::tuple("--shutter 0.25,1", 0.25f, 1.f),
                                             {"--freeze 0.3", 0.3f, 0.3f},
                                             {"--freeze 1", 1.f, 1.f}}) {
        const ViewOptions options = parsed(words + std::string(" --focus-from 1 --focus-to 4 --frames 4"));
        EXPECT_TRUE(options.changesTime());
        EXPECT_TRUE(options.refocuses());
        const std::vector<ViewStep> steps = viewSteps(options);
        ASSERT_EQ(steps.size(), 4u);
        EXPECT_EQ(*steps[0].focusDistance, 1);
        EXPECT_DOUBLE_EQ(*steps[2].focusDistance, 2);
        EXPECT_EQ(*steps[3].focusDistance, 4);
        for (const ViewStep& step : steps) {
            EXPECT_EQ(step.shutter.open, open);
            EXPECT_EQ(step.shutter.close, close);
        }
    }
}

TEST(ViewOptions, slowMotionTakesEvenStepsOfTimeBothEndsIncluded) {
    const ViewOptions options = parsed("--freeze-from 0.9 --freeze-to 0.1 --frames 5 --focus-distance 3");
    const std::vector<ViewStep> steps = viewSteps(options);
    ASSERT_EQ(steps.size(), 5u);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        EXPECT_NEAR(steps[i].shutter.open, 0.9f - 0.2f * float(i), 1e-6f);
        EXPECT_EQ(steps[i].shutter.open, steps[i].shutter.close);
        EXPECT_EQ(*steps[i].focusDistance, 3);
    }
    EXPECT_EQ(steps[4].shutter.close, 0.1f);
}

} // namespace
} // namespace slant::commands
