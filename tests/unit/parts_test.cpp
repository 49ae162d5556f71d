// Halves of light fields, and sums of fields.
#include "lightfield/parts.h"
#include "support/synthetic.h"

#include <gtest/gtest.h>

namespace slant {
namespace {

const Rect kFrame{2, 3, 9, 8};

LightField fieldOf(const std::function<int(int x, int y)>& countAt) {
    LightField field = synthetic::sample(synthetic::discsOverChecks(), kFrame, 2, countAt, 5);
    // Says which sample it was.
    for (std::size_t i = 0; i < field.radiance.size(); ++i) field.radiance[i] = glm::vec3(float(i));
    return field;
}

std::vector<float> namesOf(const LightField& field, std::size_t pixel) {
    std::vector<float> names;
    for (std::size_t i = field.firstSample(pixel); i < field.firstSample(pixel + 1); ++i)
        names.push_back(field.radiance[i].x);
    return names;
}

TEST(Parts, halvesHoldEverySampleOnceInItsPixel) {
    for (const auto& countAt : {std::function<int(int, int)>([](int, int) { return 4; }),
                                std::function<int(int, int)>([](int, int) { return 1; }),
                                std::function<int(int, int)>([](int x, int y) { return (3 * x + y) % 5; })}) {
        const LightField field = fieldOf(countAt);
        const LightField halves[] = {halfOf(field, 0), halfOf(field, 1)};
        for (std::size_t pixel = 0; pixel < field.bounds.area(); ++pixel) {
            std::vector<float> both = namesOf(halves[0], pixel), second = namesOf(halves[1], pixel);
            EXPECT_LE(std::max(both.size(), second.size()), (field.samplesOf(pixel) + 1) / 2);
            both.insert(both.end(), second.begin(), second.end());
            std::ranges::sort(both);
            EXPECT_EQ(both, namesOf(field, pixel)) << pixel;
        }
        EXPECT_EQ(halves[0].frame, field.frame);
        EXPECT_EQ(halves[1].bounds, field.bounds);
    }
}

TEST(Parts, neighboursTakeTurnsWithOddSamples) {
    const LightField half = halfOf(fieldOf([](int, int) { return 3; }), 0);
    const auto width = std::size_t(half.bounds.width());
    for (std::size_t pixel = 1; pixel < half.bounds.area(); ++pixel)
        if (pixel % width > 0) {
            EXPECT_EQ(half.samplesOf(pixel) + half.samplesOf(pixel - 1), 3u);
        }
}

TEST(Parts, addedSamplesStandBehindThoseOfTheirPixel) {
    LightField field = fieldOf([](int x, int) { return 1 + x % 2; });
    const LightField before = field;
    LightField more = synthetic::sample(
        synthetic::discsOverChecks(), kFrame, 0, [](int x, int y) { return (x + y) % 3; }, 6);
    for (std::size_t i = 0; i < more.radiance.size(); ++i) more.radiance[i] = glm::vec3(1000 + float(i));
    addSamples(field, more);
    EXPECT_EQ(field.samples.size(), before.samples.size() + more.samples.size());
    for (std::size_t pixel = 0; pixel < field.bounds.area(); ++pixel) {
        std::vector<float> expected = namesOf(before, pixel);
        const int x = field.bounds.x0 + int(pixel) % field.bounds.width(),
                  y = field.bounds.y0 + int(pixel) / field.bounds.width();
        if (kFrame.contains(x, y)) {
            const auto other = std::size_t((y - kFrame.y0) * kFrame.width() + x - kFrame.x0);
            for (const float name : namesOf(more, other)) expected.push_back(name);
        }
        EXPECT_EQ(namesOf(field, pixel), expected) << pixel;
        for (std::size_t i = field.firstSample(pixel); i < field.firstSample(pixel + 1); ++i)
            EXPECT_EQ(std::floor(field.samples[i].x), x);
    }
}

TEST(Parts, aFieldWithoutMotionStandsStillBesideOneThatMoves) {
    LightField field = fieldOf([](int, int) { return 1; });
    LightField moving = fieldOf([](int, int) { return 1; });
    moving.motion.assign(moving.samples.size(), glm::vec3(1, 2, 3));
    addSamples(field, moving);
    ASSERT_EQ(field.motion.size(), field.samples.size());
    EXPECT_EQ(field.motion[0], glm::vec3(0));
    EXPECT_EQ(field.motion[1], glm::vec3(1, 2, 3));
}

} // namespace
} // namespace slant
