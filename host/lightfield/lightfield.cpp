#include "lightfield/lightfield.h"

#include "base/error.h"
#include "base/parallel.h"
#include "lightfield/motion.h"
#include "shared/reconstruct.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

namespace slant {
namespace {

/// Largest |(u, v)|: rounding may put a sample of the rim a little outside.
constexpr float kLensRadiusBound = 1.0001f;

/// No light is as bright; a picture's sums, and products with reflectances, stay finite.
constexpr float kRadianceBound = 1e15f;

/// Clears a component that is not finite or negative; returns which it was.
void repairComponent(float& value, bool& nonFinite, bool& negative) {
    if (!(std::abs(value) < kRadianceBound)) {
        nonFinite = true;
        value = 0;
    } else if (value < 0) {
        negative = true;
        value = 0;
    }
}

} // namespace

std::uint64_t FieldDefects::total() const {
    return nonFiniteRadiance + negativeRadiance + badDepth + outsideLens + badPosition + badMotion +
           limitedMotion;
}

void FieldDefects::add(const FieldDefects& other) {
    nonFiniteRadiance += other.nonFiniteRadiance;
    negativeRadiance += other.negativeRadiance;
    badDepth += other.badDepth;
    outsideLens += other.outsideLens;
    badPosition += other.badPosition;
    badMotion += other.badMotion;
    limitedMotion += other.limitedMotion;
}

void SampleSet::resize(std::size_t count, SamplePlanes planes) {
    samples.resize(count);
    radiance.resize(count);
    albedo.resize(planes.albedo ? count : 0);
    normal.resize(planes.albedo || planes.shading ? count : 0);
    motion.resize(planes.motion ? count : 0);
    for (auto* plane : {&illumination, &reflectance, &reflection}) plane->resize(planes.shading ? count : 0);
    for (auto* plane : {&position, &light, &blocker, &direct}) plane->resize(planes.shadows ? count : 0);
}

SampleSpans spansOf(SampleSet& set) {
    return {set.samples,     set.radiance,   set.albedo,   set.normal, set.motion,  set.illumination,
            set.reflectance, set.reflection, set.position, set.light,  set.blocker, set.direct};
}

void dropZeroMotion(LightField& field) {
    const auto isZero = [](const glm::vec3& m) { return m == glm::vec3(0); };
    if (std::all_of(field.motion.begin(), field.motion.end(), isZero))
        std::vector<glm::vec3>().swap(field.motion);
}

void repair(const LightField& field, LightFieldSample& s, glm::vec3& radiance, glm::vec3& motion,
            FieldDefects& defects) {
    bool nonFinite = false, negative = false;
    for (int i = 0; i < 3; ++i) repairComponent(radiance[i], nonFinite, negative);
    defects.nonFiniteRadiance += nonFinite;
    defects.negativeRadiance += negative;

    const bool badDepth = !(s.w > 0);
    const bool outsideLens = !(s.u * s.u + s.v * s.v <= kLensRadiusBound * kLensRadiusBound);
    const bool badPosition =
        !std::isfinite(s.x) || !std::isfinite(s.y) || !std::isfinite(s.t) || !(std::abs(s.slope) < kFarPx);
    bool bad = badDepth || outsideLens || badPosition, badMotion = false;
    if (!bad && motion != glm::vec3(0)) {
        badMotion = !isFinite(motion) || !isFinite(relativeMotion(s, motion));
        const bool limited = !badMotion && limitMotion(field, s, motion);
        badMotion = badMotion || !isFinite({displacementPx(field, s, motion), 0}); // positions beyond bounds
        defects.limitedMotion += limited && !badMotion;
        bad = badMotion;
    }
    defects.badDepth += badDepth;
    defects.outsideLens += outsideLens;
    defects.badPosition += badPosition;
    defects.badMotion += badMotion;
    if (!bad) return;
    s.slope = std::numeric_limits<float>::quiet_NaN();
    motion = glm::vec3(0);
}

SampleCounts sampleCounts(const LightField& field) {
    const std::size_t pixels = field.bounds.area();
    SampleCounts counts{field.samplesOf(0), field.samplesOf(0),
                        double(field.firstSample(pixels)) / double(pixels)};
    for (std::size_t i = 1; i < field.pixelStart.size(); ++i) {
        counts.min = std::min(counts.min, field.samplesOf(i - 1));
        counts.max = std::max(counts.max, field.samplesOf(i - 1));
    }
    return counts;
}

void setSampleCounts(LightField& field, std::span<const std::uint32_t> counts) {
    field.pixelStart.clear();
    field.samplesPerPixel = int(counts[0]);
    if (std::all_of(counts.begin(), counts.end(), [&](std::uint32_t n) { return n == counts[0]; })) return;
    field.samplesPerPixel = 0;
    field.pixelStart.resize(counts.size() + 1);
    std::partial_sum(counts.begin(), counts.end(), field.pixelStart.begin() + 1);
}

bool hasOwnSlopes(const LightField& field) {
    std::atomic<bool> found = false;
    parallelFor(0, field.samples.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
        const auto differs = [&](const LightFieldSample& s) {
            const float slope = field.slopeModel(s.w);
            return s.slope != slope && !(std::isnan(s.slope) && std::isnan(slope));
        };
        if (std::any_of(field.samples.begin() + long(first), field.samples.begin() + long(last), differs))
            found = true;
    });
    return found;
}

bool isThinLens(const LightField& field) {
    return field.lensMap.empty() && !hasOwnSlopes(field);
}

namespace {

/// Throws Error(usage) unless there are all planes that field.planes() speaks of, of the samples' length.
void checkPlanes(const LightField& field) {
    SampleSet expected;
    expected.resize(1, field.planes());
    for (std::size_t i = 0; i < kValuePlanes.size(); ++i) {
        const auto plane = kValuePlanes[i];
        if ((field.*plane).size() != field.samples.size() * (expected.*plane).size())
            throw Error(ErrorCode::usage, fmt::format("{} samples have {} values of {}", field.samples.size(),
                                                      (field.*plane).size(), kValuePlaneNames[i]));
    }
    if (field.planes().shadows && !field.hasShading())
        throw Error(ErrorCode::usage, "shadow rays without illumination");
}

} // namespace

FieldDefects sanitize(LightField& field) {
    checkPlanes(field);
    FieldDefects sum;
    std::mutex mutex;
    parallelFor(0, field.samples.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
        FieldDefects local;
        for (std::size_t i = first; i < last; ++i) {
            glm::vec3 still(0), &motion = field.moves() ? field.motion[i] : still;
            repair(field, field.samples[i], field.radiance[i], motion, local);
            if (!field.hasShading()) continue;
            bool unused = false;
            for (glm::vec3* value : {&field.illumination[i], &field.reflectance[i], &field.reflection[i]})
                for (int c = 0; c < 3; ++c) repairComponent((*value)[c], unused, unused);
            if (!field.hasShadows()) continue;
            for (int c = 0; c < 3; ++c) repairComponent(field.direct[i][c], unused, unused);
        }
        const std::lock_guard lock(mutex);
        sum.add(local);
    });
    dropZeroMotion(field);
    return sum;
}

} // namespace slant
