// Small light fields for tests of their files.
#pragma once
#include "lightfield/field_file.h"
#include "support/synthetic.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace slant::test {

/// Overscan, negative coordinates, background, garbage in some samples, and every detail set.
inline FieldFile richField(int spp = 3) {
    FieldFile file;
    LightField& field = file.field;
    field = synthetic::sample(synthetic::discsOverChecks(), {-2, 1, 9, 8}, 4, spp, 3);
    field.slopeModel = {-35.25f, 11.125f};
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> rubbish = {kInfinity, kNaN, -kInfinity, 0, -3, 1e-42f, 3e38f};
    for (std::size_t i = 0; i < field.samples.size(); ++i) {
        LightFieldSample& s = field.samples[i];
        s.w = 0.7f + float(i % 13) / 3;
        if (i % 11 == 0) s.w = rubbish[i / 11 % rubbish.size()];
        if (i % 17 == 0) field.radiance[i].g = rubbish[i / 17 % rubbish.size()];
        s.alpha = std::isinf(s.w) ? 0.f : 1.f;
        s.slope = field.slopeModel(s.w);
    }
    file.details = {{-5, -4, 40, 30},
                    PixelFilter{FilterKind::mitchell, {1.7f, 2}, 0.5f, 0.4f, 0.1f},
                    0.3f,
                    0.05f,
                    "m",
                    "a scene, written by hand",
                    12345678901234567890u};
    return file;
}

/// The same with motion, garbage in some samples here, too.
inline FieldFile richMovingField(int spp = 3) {
    FieldFile file = richField(spp);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> rubbish = {kInfinity, kNaN, -0.f, -1e30f, 3e38f, 1e-42f, -7};
    synthetic::Random random(8);
    for (std::size_t i = 0; i < file.field.samples.size(); ++i) {
        file.field.motion.emplace_back(9 * random.uniform() - 3, random.uniform() / 3, random.uniform() / 8);
        if (i % 5 == 0) file.field.motion[i] = glm::vec3(-0.f, 0, 0);
        if (i % 7 == 0) file.field.motion[i][int(i % 3)] = rubbish[i / 7 % rubbish.size()];
    }
    return file;
}

/// richField with these planes, garbage in some samples here, too.
inline FieldFile fieldWithPlanes(SamplePlanes planes) {
    FieldFile file = richField();
    LightField& field = file.field;
    field.resize(field.samples.size(), planes);
    synthetic::Random random(4);
    for (const auto plane : kValuePlanes) {
        if (plane == &SampleSet::radiance) continue;
        std::vector<glm::vec3>& values = field.*plane;
        for (glm::vec3& value : values) value = {random.uniform(), 3 * random.uniform(), -random.uniform()};
        for (std::size_t i = 0; i < values.size(); i += 9)
            values[i].g = std::numeric_limits<float>::quiet_NaN();
    }
    return file;
}

/// Bits, so that NaN equals itself.
inline bool sameBits(const LightField& a, const LightField& b) {
    const auto same = [](const auto& left, const auto& right) {
        return left.size() == right.size() &&
               (left.empty() || std::memcmp(left.data(), right.data(), left.size() * sizeof(left[0])) == 0);
    };
    return same(a.samples, b.samples) &&
           std::ranges::all_of(kValuePlanes, [&](const auto plane) { return same(a.*plane, b.*plane); });
}

} // namespace slant::test
