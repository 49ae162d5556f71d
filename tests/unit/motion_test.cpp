// Motion of samples: which ones are left out or limited, how far points move, what a picture shows of it.
#include "lightfield/motion.h"
#include "lightfield/refocus.h"
#include "lightfield/summary.h"
#include "lightfield/value_plane.h"
#include "support/expect_error.h"
#include "support/field_samples.h"

namespace slant {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Of one pixel at the origin, with as many samples as there are motions.
LightField fieldOf(const LightFieldSample& sample, const std::vector<glm::vec3>& motions) {
    LightField field;
    field.bounds = field.frame = {0, 0, 1, 1};
    field.samplesPerPixel = int(motions.size());
    field.slopeModel = {-8, 3};
    field.samples.assign(motions.size(), sample);
    for (LightFieldSample& s : field.samples) s.slope = field.slopeModel(s.w);
    field.radiance.resize(motions.size());
    field.motion = motions;
    return field;
}

const LightFieldSample kSample{0.5f, 0.25f, 0.6f, -0.3f, 0.25f, 4, 0, 1};

/// As in lightfield.h, in doubles; w = 1 stands for infinity.
glm::dvec3 at(const LightField& field, std::size_t i, double time) {
    const LightFieldSample& s = field.samples[i];
    const glm::dvec2 p = glm::dvec2(s.x, s.y) - double(s.slope) * glm::dvec2(s.u, s.v);
    const double w = std::isinf(s.w) ? 1 : double(s.w);
    const glm::dvec3 there = glm::dvec3(w * p, w) + (time - double(s.t)) * glm::dvec3(field.motion[i]);
    return {there.x / there.z, there.y / there.z, there.z};
}

TEST(Motion, thatIsNotFiniteDisablesItsSample) {
    LightField field =
        fieldOf(kSample, {{1, 0, 0}, {kInfinity, 0, 0}, {0, kNaN, 0}, {0, 0, -kInfinity}, {0, 0, kInfinity}});
    const FieldDefects defects = sanitize(field);
    EXPECT_EQ(defects.badMotion, 4u);
    EXPECT_EQ(defects.total(), 4u);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(std::isnan(field.samples[i].slope), i > 0) << i;
        EXPECT_EQ(field.motion[i], glm::vec3(i == 0, 0, 0)) << i;
    }
}

TEST(Motion, ofSamplesThatAreDisabledIsZero) {
    LightField field = fieldOf(kSample, {{1, 2, 3}, {4, 5, 6}, {kNaN, 1, 1}});
    field.samples[1].u = 2;
    field.samples[2].w = -1;
    const FieldDefects defects = sanitize(field);
    EXPECT_EQ(defects.total(), 2u);
    EXPECT_EQ(field.motion, (std::vector<glm::vec3>{{1, 2, 3}, {0, 0, 0}, {0, 0, 0}}));
}

TEST(Motion, ofZeroIsDropped) {
    LightField field = fieldOf(kSample, {{0, 0, 0}, {0, -0.f, 0}, {kNaN, 0, 0}});
    EXPECT_EQ(sanitize(field).badMotion, 1u);
    EXPECT_FALSE(field.moves());
    field.motion.resize(2);
    test::expectError(ErrorCode::usage, "3 samples have 2 values of motion", [&] { sanitize(field); });
}

/// Whatever comes nearer than a sixteenth of its depth keeps its velocity, and everything else its motion.
TEST(Motion, throughTheEyeIsLimited) {
    synthetic::Random random(3);
    for (int i = 0; i < 20000; ++i) {
        LightFieldSample s = kSample;
        s.x = 2000 * random.uniform();
        s.t = i % 7 == 0 ? 0 : i % 7 == 1 ? 1 : random.uniform();
        s.w = i % 11 == 0 ? kInfinity : std::exp(8 * random.uniform() - 4);
        const float depth = std::isinf(s.w) ? 1 : s.w;
        const float speed = std::exp(12 * random.uniform() - 5) * (i % 2 ? -1.f : 1.f);
        const glm::vec3 motion = depth * glm::vec3(50 * random.uniform(), -20 * random.uniform(), speed);
        LightField field = fieldOf(s, {motion});
        const LightField before = field;
        const double nearest = std::min(at(field, 0, 0).z, at(field, 0, 1).z) / double(depth);
        const bool expected = nearest < 1. / 16;
        const FieldDefects defects = sanitize(field);
        if (std::abs(nearest - 1. / 16) > 1e-6) {
            ASSERT_EQ(defects.limitedMotion, expected) << nearest;
        }
        if (!defects.limitedMotion) {
            ASSERT_EQ(field.motion[0], motion);
            continue;
        }
        ASSERT_NEAR(std::min(at(field, 0, 0).z, at(field, 0, 1).z) / double(depth), 1. / 16, 1e-5);
        const glm::vec3 q = relativeMotion(field.samples[0], field.motion[0]);
        for (const float time : {0.f, 1.f}) ASSERT_GE(1 + (time - s.t) * q.z, 1.f / 16);
        const glm::vec3 limited = field.motion[0];
        ASSERT_EQ(sanitize(field).total(), 0u) << "once and for all";
        ASSERT_EQ(field.motion[0], limited);
        const auto velocity = [](const LightField& of) {
            const glm::dvec3 m = of.motion[0], p = at(of, 0, double(of.samples[0].t));
            return (glm::dvec2(m) - m.z * glm::dvec2(p)) / p.z;
        };
        const double tolerance = 1e-6 * 2000 * std::max(1.f, std::abs(speed));
        ASSERT_NEAR(velocity(field).x, velocity(before).x, tolerance);
        ASSERT_NEAR(velocity(field).y, velocity(before).y, tolerance);
    }
}

TEST(Motion, ofTheSmallestDepthsIsLimitedToo) {
    for (const float w : {1.4e-45f, 1e-44f, 1e-40f, 1e-38f, 3e38f}) {
        LightFieldSample s = kSample;
        s.w = w;
        LightField field = fieldOf(s, {{0, 0, -1.4e-45f}, {0, 0, -2 * w}, {0, 0, 30 * w}});
        for (LightFieldSample& each : field.samples) each.slope = 1;
        sanitize(field);
        for (std::size_t i = 0; i < field.motion.size(); ++i) {
            const glm::vec3 q = relativeMotion(field.samples[i], field.motion[i]);
            for (const float time : {0.f, 1.f}) EXPECT_GE(1 + (time - s.t) * q.z, 1.f / 32) << w << ' ' << i;
        }
    }
}

TEST(Motion, displacementsAreThoseOfTheTrajectories) {
    synthetic::Random random(7);
    for (int i = 0; i < 1000; ++i) {
        LightFieldSample s = kSample;
        s.t = random.uniform();
        s.w = i % 5 == 0 ? kInfinity : 1 + 9 * random.uniform();
        LightField field = fieldOf(s, {{9 * random.uniform(), 4, 2 * random.uniform() - 1}});
        sanitize(field);
        const glm::dvec2 expected = glm::dvec2(at(field, 0, 1)) - glm::dvec2(at(field, 0, 0));
        const glm::vec2 got = displacementPx(field, field.samples[0], field.motion[0]);
        EXPECT_NEAR(got.x, expected.x, 1e-4 * (1 + std::abs(expected.x)));
        EXPECT_NEAR(got.y, expected.y, 1e-4 * (1 + std::abs(expected.y)));
        const glm::vec2 shown = fromForwardValue(valueOf(field, ValuePlane::forward, 0));
        EXPECT_NEAR(shown.x, got.x, 1e-4);
        EXPECT_NEAR(shown.y, -got.y, 1e-4) << "upwards";
    }
}

TEST(Motion, asAValueIsNeverNegative) {
    LightField field =
        fieldOf(kSample, {{4, 8, 0}, {-4, 8, 0}, {-4, -8, 0}, {4, -8, 0}, {0, 0, 0}, {kNaN, 0, 0}});
    for (std::size_t i = 0; i < field.motion.size(); ++i) {
        const glm::vec3 value = valueOf(field, ValuePlane::forward, i), m = field.motion[i];
        EXPECT_EQ(std::min({value.x, value.y, value.z}), 0) << "no larger than necessary";
        EXPECT_EQ(fromForwardValue(value), i < 5 ? glm::vec2(m.x, -m.y) / 4.f : glm::vec2(0));
    }
    field.motion.clear();
    EXPECT_EQ(valueOf(field, ValuePlane::forward, 0), glm::vec3(0));
}

TEST(Motion, isSummedUp) {
    LightField field =
        fieldOf(kSample, {{12, 16, 0}, {0, 0, 0}, {0, -4, 0}, {0, 8, 0}, {kNaN, 0, 0}, {0, 0, -9}});
    const FieldSummary summary = summarize(field);
    EXPECT_EQ(summary.moving, 4u);
    EXPECT_EQ(summary.defects.badMotion, 1u);
    EXPECT_EQ(summary.defects.limitedMotion, 1u);
    field.motion.pop_back();
    field.samples.pop_back();
    field.radiance.pop_back();
    field.samplesPerPixel = 5;
    EXPECT_EQ(summarize(field).moving, 3u);
    EXPECT_EQ(summarize(field).largestMotionPx, 5) << "(12, 16) over a depth of 4";
    EXPECT_EQ(summarize(field).medianMotionPx, 2);
}

TEST(Motion, reachesBeyondTheSamplesAsBlurDoes) {
    LightField field =
        synthetic::sample({{0, [](glm::vec2) { return true; }, [](glm::vec2) { return glm::vec3(1); }}},
                          {0, 0, 20, 20}, 3, 1, 1);
    EXPECT_EQ(missingOverscanPx(field, {}), 0);
    field.motion.assign(field.samples.size(), glm::vec3(8, 0, 0));
    EXPECT_NEAR(missingOverscanPx(field, {}), 8 - 3, 1);
    // A point that comes from depth 1, where the focus is, to 1/4 is spread over 12 pixels there.
    field.motion.assign(field.samples.size(), glm::vec3(0));
    field.slopeModel = {-4, 4};
    const std::size_t middle = 13 * 26 + 13;
    LightFieldSample& s = field.samples[middle];
    s = {10, 10, 0, 0, 0, 1, 0, 1};
    field.motion[middle] = -0.75f * glm::vec3(10, 10, 1);
    EXPECT_EQ(missingOverscanPx(field, {0, 1}), 0);
    EXPECT_EQ(missingOverscanPx(field, {0, 3}), 36 - 13);
}

} // namespace
} // namespace slant
