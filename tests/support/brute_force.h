// What an output sees, as host/reconstruct/README.md describes it: from all samples of a light field, in
// double precision, without bins, bricks or lists.
#pragma once
#include "reconstruct/bins.h"
#include "shared/output.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace slant::test {

/// Whether the convex hull of points contains the origin: every half plane has a point.
inline bool surroundOrigin(std::span<const glm::dvec2> points) {
    std::vector<double> angles;
    for (const glm::dvec2 p : points) angles.push_back(std::atan2(p.y, p.x));
    if (angles.empty()) return false;
    std::sort(angles.begin(), angles.end());
    double widest = angles.front() + 2 * std::numbers::pi - angles.back();
    for (std::size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
    return widest < std::numbers::pi;
}

class BruteForce {
public:
    struct Sample {
        glm::dvec2 xy, uv;
        double slope;
        double radiusRatio; ///< R over its own radius
        double weight;      ///< of visibility
        glm::dvec3 rgb;
        bool binned;
    };
    /// A sample from an output's place on the lens.
    struct Seen {
        glm::dvec2 offset;
        double distance; ///< as if its own radius were R
        Sample sample;
    };
    using Surface = std::vector<Seen>;

    struct Shares {
        double inner = 0, outer = 0, slope = 0; ///< weights of tents over R and 2 R; slope by the inner one
        glm::dvec3 innerRgb{0}, outerRgb{0};

        glm::dvec3 mean() const { return inner > 0 ? innerRgb / inner : outerRgb / outer; }
    };

    std::vector<Sample> samples;
    double radius, gap;

    /// Own radii and visibility weights are those of the bins.
    BruteForce(const LightField& field, const Bins& bins)
        : radius(double(bins.grid.radiusPx)), gap(double(bins.grid.surfaceGap)) {
        const SceneSideSamples source(field);
        const SampleDensity density = densityOf(source);
        for (std::size_t i = 0; i < field.samples.size(); ++i) {
            const LightFieldSample& s = field.samples[i];
            const glm::vec2 p = glm::vec2(s.x, s.y) - s.slope * glm::vec2(s.u, s.v);
            const float ratio =
                std::isfinite(s.slope) ? radiusRatioAt(density, p, s.slope, bins.grid.radiusPx) : 1.f;
            samples.push_back({{s.x, s.y}, {s.u, s.v}, s.slope, ratio, 1, field.radiance[i], false});
        }
        for (std::size_t record = 0; record < bins.samples.size(); ++record) {
            samples[bins.samples[record]].weight = double(bins.positions[record].w);
            samples[bins.samples[record]].binned = true;
        }
    }

    /// Those within `searchRadius`, or less where their own radius is less than R: down to 1 / maxRatio.
    /// Front to back.
    std::vector<Seen> seen(const Output& o, double searchRadius, double maxRatio = 1e30) const {
        std::vector<Seen> found;
        const glm::dvec3 m(o.filmMetric);
        for (const Sample& s : samples) {
            const glm::dvec2 d = s.xy + s.slope * (glm::dvec2(o.uv) - s.uv) - glm::dvec2(o.xy);
            const glm::dvec2 offset =
                o.onSceneSide ? glm::dvec2(m.x * d.x + m.y * d.y, m.y * d.x + m.z * d.y) : d;
            if (!(glm::dot(offset, offset) < searchRadius * searchRadius))
                continue; // own radii are no greater
            const double distance = glm::length(offset) * std::min(s.radiusRatio, maxRatio);
            if (distance < searchRadius) found.push_back({offset, distance, s});
        }
        std::stable_sort(found.begin(), found.end(),
                         [](const Seen& a, const Seen& b) { return a.sample.slope < b.sample.slope; });
        return found;
    }

    /// Split at gaps in slope.
    std::vector<Surface> surfaces(const Output& o, double searchRadius, double maxRatio = 1e30) const {
        std::vector<Surface> parted;
        for (const Seen& s : seen(o, searchRadius, maxRatio)) {
            if (parted.empty() || s.sample.slope > parted.back().back().sample.slope + gap)
                parted.emplace_back();
            parted.back().push_back(s);
        }
        return parted;
    }

    /// For a surface all around, the sum of the weights of a tent with radius `base` and height 1: pi / 3
    /// base^2 samples.
    double fullWeight(double base) const {
        const double density = double(kSearchRadius) * double(kSearchRadius) / (radius * radius);
        return std::numbers::pi / 3 * base * base * density;
    }

    static Shares shares(const Surface& surface, double base) {
        Shares sum;
        for (const Seen& s : surface) {
            const double inner = s.sample.weight * std::max(0.0, 1 - s.distance / base);
            const double outer = s.sample.weight * (2 - s.distance / base);
            sum.inner += inner;
            sum.outer += outer;
            sum.slope += inner * s.sample.slope;
            sum.innerRgb += inner * s.sample.rgb;
            sum.outerRgb += outer * s.sample.rgb;
        }
        return sum;
    }

    static bool surrounds(const Surface& surface) {
        std::vector<glm::dvec2> offsets;
        for (const Seen& s : surface) offsets.push_back(s.offset);
        return surroundOrigin(offsets);
    }

    /// From the samples within twice the base radius.
    bool isSolid(const Surface& surface, double base) const {
        return surrounds(surface) &&
               shares(surface, base).outer >= double(kSolidOuter) * 8 * fullWeight(base);
    }

    /// The only surface within R, or the front one if it is solid; nothing if that does not decide.
    std::optional<glm::dvec3> nearest(const Output& o) const {
        const std::vector<Surface> parted = surfaces(o, radius);
        if (parted.empty()) return {};
        const Shares front = shares(parted.front(), radius);
        const bool solid =
            surrounds(parted.front()) && front.inner >= double(kSolidInner) * fullWeight(radius);
        if (parted.size() > 1 && !solid) return {};
        return front.innerRgb / front.inner;
    }

    /// All surfaces within twice the base radius, composited; nothing if there are none.
    std::optional<glm::dvec3> visible(const Output& o, double base) const {
        const std::vector<Surface> parted = surfaces(o, 2 * base);
        if (parted.empty()) return {};
        glm::dvec3 rgb(0);
        double through = 1;
        for (const Surface& surface : parted) {
            const Shares s = shares(surface, base);
            const bool last = &surface == &parted.back() || isSolid(surface, base);
            const double opacity = last ? 1 : std::min(s.inner / fullWeight(base), 1.0);
            rgb += through * opacity * s.mean();
            through *= 1 - opacity;
        }
        return rgb;
    }
};

} // namespace slant::test
