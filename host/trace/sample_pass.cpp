#include "trace/sample_pass.h"

#include "base/error.h"
#include "base/parallel.h"
#include "lib/trajectory.glsl"
#include "lightfield/parts.h"
#include "scene/filter_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <new>
#include <numeric>
#include <stdexcept>

namespace slant {
namespace {

constexpr double kMebibyte = 1 << 20;
/// Patterns of further samples have seeds that nobody chooses.
constexpr int kPassShift = 48;
/// Of a field, while samples are added to it.
constexpr std::uint64_t kCopies = 2;
/// A miss of straight motions is worth a warning from this on, where more than this part of samples has it.
constexpr float kSeenMissPx = 1;
constexpr double kSeenShare = 0.001;

std::uint64_t bytesOf(std::uint64_t samples, SamplePlanes planes) {
    SampleSet one;
    one.resize(1, planes);
    std::uint64_t perSample = sizeof(LightFieldSample);
    for (const auto plane : kValuePlanes) perSample += sizeof(glm::vec3) * (one.*plane).size();
    return samples * perSample;
}

std::uint64_t fieldBytes(Rect bounds, const SampleOptions& options) {
    return bytesOf(std::uint64_t(bounds.area()) * std::uint64_t(options.samplesPerPixel), options.planes);
}

/// Throws Error(resources) if `bytes` are more than the budget.
void requireBudget(std::uint64_t bytes, Rect bounds, double samplesPerPixel, const SampleOptions& options) {
    if (bytes > options.memoryBytes)
        throw Error(
            ErrorCode::resources,
            fmt::format(
                "{} x {} pixels with {:.6g} samples each need {:.0f} MiB of memory, the budget is {:.0f} MiB",
                bounds.width(), bounds.height(), samplesPerPixel, double(bytes) / kMebibyte,
                double(options.memoryBytes) / kMebibyte));
}

/// Room for so many samples.
SampleSet roomFor(std::size_t count, SamplePlanes planes) {
    SampleSet set;
    try {
        set.resize(count, planes);
    } catch (const std::exception&) { // bad_alloc or length_error
        throw Error(ErrorCode::resources, fmt::format("no memory for {} samples ({:.0f} MiB)", count,
                                                      double(bytesOf(count, planes)) / kMebibyte));
    }
    return set;
}

SampleSet samplesOf(Rect pixels, const SampleOptions& options) {
    return roomFor(pixels.area() * std::size_t(options.samplesPerPixel), options.planes);
}

void copyRows(const SampleSet& from, Rect pixels, SampleSet& to, Rect bounds, int samplesPerPixel) {
    const std::size_t row = std::size_t(pixels.width()) * std::size_t(samplesPerPixel);
    for (int y = pixels.y0; y < pixels.y1; ++y) {
        const std::size_t source = std::size_t(y - pixels.y0) * row;
        const std::size_t target =
            (std::size_t(y - bounds.y0) * std::size_t(bounds.width()) + std::size_t(pixels.x0 - bounds.x0)) *
            std::size_t(samplesPerPixel);
        copySamples(from, source, to, target, row);
    }
}

/// Samples count as they are seen while they are farther than this part of their depth.
constexpr float kNearest = 1.f / 16;

/// A sample's point at another time, as the middle of the lens sees it.
struct Seen {
    glm::vec2 shift; ///< of its pinhole position
    float slope;
};

/// `after` the sample's own time, at which its pinhole position is `p`.
Seen seenLater(const LightFieldSample& s, glm::vec2 p, const glm::vec3& motion, float after,
               SlopeModel slopeModel) {
    const float w = std::isinf(s.w) ? 1 : s.w, least = w * kNearest;
    if (w + after * motion.z < least) after = (least - w) / motion.z;
    const float depth = w + after * motion.z;
    return {after / depth * (glm::vec2(motion) - motion.z * p),
            std::isinf(s.w) ? s.slope : slopeModel(depth)};
}

/// Visits it when the shutter opens and when it closes: at all times between, its place and its slope lie
/// between, and so do the ends of its blur.
template <typename Visit>
void visitEnds(const LightFieldSample& s, glm::vec2 p, const glm::vec3& motion, SlopeModel slopeModel,
               Visit&& visit) {
    if (motion == glm::vec3(0)) {
        visit(Seen{glm::vec2(0), s.slope});
        return;
    }
    visit(seenLater(s, p, motion, -s.t, slopeModel));
    visit(seenLater(s, p, motion, 1 - s.t, slopeModel));
}

/// How far trajectories reach beyond a frame, in pixels; may be negative.
struct Reach {
    Rect frame;
    SlopeModel slopeModel;
    float left = 0, top = 0, right = 0, bottom = 0;

    void add(const LightFieldSample& s, const glm::vec3& motion) {
        if (!std::isfinite(s.slope)) return;
        const glm::vec2 p = pinholeOf(vec2(s.x, s.y), vec2(s.u, s.v), s.slope);
        visitEnds(s, p, motion, slopeModel, [&](const Seen& seen) {
            const float radius = std::abs(seen.slope);
            include(p + seen.shift - radius, p + seen.shift + radius);
        });
    }
    /// Through a lens: where the sample's point is seen from the rim of its pupil.
    void add(const LightFieldSample& s, const glm::vec3& motion, const LensMap& lens) {
        // Nothing that keeps still moves by more than this many times its slope.
        const float most = 3 * std::abs(s.slope);
        if (motion == glm::vec3(0) && !(s.x - most < float(frame.x0) || s.x + most > float(frame.x1) ||
                                        s.y - most < float(frame.y0) || s.y + most > float(frame.y1)))
            return;
        const glm::vec2 raster(s.x, s.y);
        const SceneRay here = lens.at(raster, {s.u, s.v});
        if (!(here.openShare > 0) || !std::isfinite(s.slope)) return;
        const glm::vec3& m = here.filmMetric;
        const glm::vec2 p = here.xy - s.slope * here.uv;
        visitEnds(s, p, motion, slopeModel, [&](const Seen& seen) {
            const glm::vec2 shift = seen.shift + (seen.slope - s.slope) * here.uv;
            for (const glm::vec2 rim :
                 {glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(0, 1), glm::vec2(0, -1)}) {
                const glm::vec2 moved =
                    1.1f * seen.slope * (lens.at(raster, rim).uv - here.uv) + 1.1f * shift;
                const glm::vec2 film =
                    raster + glm::vec2(m.x * moved.x + m.y * moved.y, m.y * moved.x + m.z * moved.y);
                include(film, film);
            }
        });
    }
    void include(glm::vec2 low, glm::vec2 high) {
        left = std::max(left, float(frame.x0) - low.x);
        right = std::max(right, high.x - float(frame.x1));
        top = std::max(top, float(frame.y0) - low.y);
        bottom = std::max(bottom, high.y - float(frame.y1));
    }
    void add(const Reach& o) {
        left = std::max(left, o.left);
        right = std::max(right, o.right);
        top = std::max(top, o.top);
        bottom = std::max(bottom, o.bottom);
    }
};

} // namespace

Rect boundsWithOverscan(Rect frame, glm::ivec2 filterReach, std::span<const LightFieldSample> samples,
                        std::span<const glm::vec3> motion, SlopeModel slopeModel, int samplesPerPixel,
                        int limitPx, int& wantedPx, const LensMap& lens) {
    Reach reach{frame, slopeModel};
    std::mutex mutex;
    parallelFor(0, samples.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
        Reach local{frame, slopeModel};
        for (std::size_t i = first; i < last; ++i) {
            const glm::vec3 m = motion.empty() ? glm::vec3(0) : motion[i];
            if (lens.empty())
                local.add(samples[i], m);
            else
                local.add(samples[i], m, lens);
        }
        const std::lock_guard lock(mutex);
        reach.add(local);
    });
    const int radius = int(std::ceil(2 / std::sqrt(double(samplesPerPixel))));
    // Even if the filter sees nothing beside the frame, what lies at its rim has neighbours.
    const glm::ivec2 margin = radius + glm::max(filterReach, 1);
    wantedPx = 0;
    auto side = [&](float pixels, int marginPx) {
        int wanted = int(std::min(std::ceil(pixels), 1e9f)) + marginPx;
        wantedPx = std::max(wantedPx, wanted);
        return std::min(wanted, limitPx);
    };
    return {frame.x0 - side(reach.left, margin.x), frame.y0 - side(reach.top, margin.y),
            frame.x1 + side(reach.right, margin.x), frame.y1 + side(reach.bottom, margin.y)};
}

namespace {

void warnOfMisses(const MotionMisses& misses, Monitor& monitor) {
    const float usual = misses.quantilePx(1 - kSeenShare);
    if (usual > kSeenMissPx)
        monitor.warn(
            fmt::format("points turn while the shutter is open: the straight motion of samples misses "
                        "by up to {:.1f} pixels, by {:.1f} for one in {:.0f}; a shorter shutter helps",
                        misses.mostPx(), usual, 1 / kSeenShare));
}

} // namespace

LightField traceLightField(const Tracer& tracer, const Scene& scene, const SampleOptions& asked,
                           Monitor& monitor, MotionMisses* misses) {
    SampleOptions options = asked;
    options.planes.motion = tracer.moves();
    if (tracer.moves() && !tracer.camera().isProjective())
        throw badInput({scene.path, 0, 0},
                       "nothing moves straight in the picture of a spherical camera: a scene that "
                       "moves can only be rendered by `slant reference`");
    const int spp = options.samplesPerPixel;
    const Rect frame = scene.film.crop;
    const LensMap lensMap = tracer.camera().lensMap();
    const SlopeModel slopeModel = tracer.camera().slopeModel();
    const bool moving = options.planes.motion;
    auto trace = [&](Rect pixels, SampleSet& into, MotionMisses* missed) {
        tracer.trace(pixels, {0, spp}, spp, options.seed, spansOf(into), monitor, missed);
    };
    requireBudget(fieldBytes(frame, options), frame, spp, options);
    SampleSet inFrame = samplesOf(frame, options);
    MotionMisses missed;
    monitor.beginStage("trace", std::uint64_t(frame.area()) * std::uint64_t(spp), "samples");
    trace(frame, inFrame, moving ? &missed : nullptr);
    monitor.endStage();
    warnOfMisses(missed, monitor);
    if (misses) *misses = missed;

    int limit = std::max(scene.film.xResolution, scene.film.yResolution) / 2, wanted = 0;
    const Rect bounds = boundsWithOverscan(frame, filterReach(scene.filter), inFrame.samples, inFrame.motion,
                                           slopeModel, spp, limit, wanted, lensMap);
    if (wanted > limit)
        monitor.warn(
            fmt::format("{} reaches {} pixels beyond the frame; the overscan is limited to {} pixels, so "
                        "borders may lack what enters from farther out",
                        moving ? "blur or motion" : "blur", wanted, limit));
    requireBudget(fieldBytes(bounds, options) + fieldBytes(frame, options), bounds, spp, options);
    LightField field{samplesOf(bounds, options), bounds,  frame, spp, slopeModel,
                     tracer.camera().aperture(), lensMap, {}};
    copyRows(inFrame, frame, field, bounds, spp);
    monitor.beginStage("trace overscan", std::uint64_t(bounds.area() - frame.area()) * std::uint64_t(spp),
                       "samples");
    const std::array<Rect, 4> ring{
        Rect{bounds.x0, bounds.y0, bounds.x1, frame.y0}, Rect{bounds.x0, frame.y0, frame.x0, frame.y1},
        Rect{frame.x1, frame.y0, bounds.x1, frame.y1}, Rect{bounds.x0, frame.y1, bounds.x1, bounds.y1}};
    for (Rect part : ring) {
        SampleSet samples = samplesOf(part, options);
        trace(part, samples, nullptr);
        copyRows(samples, part, field, bounds, spp);
    }
    monitor.endStage();
    return field;
}

std::uint64_t roomForMore(const LightField& field, const SampleOptions& options) {
    const std::uint64_t most = options.memoryBytes / (kCopies * bytesOf(1, field.planes()));
    return most - std::min<std::uint64_t>(most, field.samples.size());
}

FieldDefects traceMore(const Tracer& tracer, const SampleOptions& options,
                       std::span<const std::uint32_t> counts, int pass, LightField& field, Monitor& monitor) {
    SamplePlanes planes = options.planes;
    planes.motion = tracer.moves();
    LightField more{{}, field.frame, field.frame, 0, field.slopeModel, field.aperture, field.lensMap, {}};
    setSampleCounts(more, counts);
    std::vector<std::uint32_t> starts(counts.size() + 1, 0);
    std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
    const std::uint64_t samples = field.samples.size() + starts.back();
    requireBudget(kCopies * bytesOf(samples, field.planes()), field.bounds,
                  double(samples) / double(field.bounds.area()), options);
    static_cast<SampleSet&>(more) = roomFor(starts.back(), planes);
    monitor.beginStage("trace more", starts.back(), "samples");
    tracer.trace(field.frame, {.starts = starts}, int(*std::ranges::max_element(counts)),
                 options.seed + (std::uint64_t(pass) << kPassShift), spansOf(more), monitor);
    monitor.endStage();
    const FieldDefects defects = sanitize(more);
    addSamples(field, more);
    return defects;
}

} // namespace slant
