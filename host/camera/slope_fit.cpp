#include "camera/slope_fit.h"

#include "camera/disc.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

constexpr int kRadii = 33;
constexpr int kDepths = 9;
constexpr int kLensSide = 8; ///< 64 lens positions

/// Straight line through slopes over inverse depth, by least squares.
struct LineFit {
    double count = 0, q = 0, qq = 0;
    glm::dvec2 s{0}, qs{0};

    void add(double inverseDepth, glm::dvec2 slope, double weight) {
        count += weight;
        q += weight * inverseDepth;
        qq += weight * inverseDepth * inverseDepth;
        s += weight * slope;
        qs += weight * inverseDepth * slope;
    }
    RadialSlope result() const {
        const double det = count * qq - q * q;
        if (!(det > 1e-12 * count * qq)) return {glm::dvec2(0), count > 0 ? s / count : s};
        return {(count * qs - q * s) / det, (qq * s - q * qs) / det};
    }
};

} // namespace

RadialSlope SlopeFit::at(SlopeFitKind fit, double px) const {
    if (fit == SlopeFitKind::lens) return whole;
    const double last = double(byRadius.size() - 1), place = std::min(px / radiusPx * last, last);
    const std::size_t k = std::min(std::size_t(place), byRadius.size() - 2);
    const double f = place - double(k);
    const RadialSlope &a = byRadius[k], &b = byRadius[k + 1];
    return {a.c1 + f * (b.c1 - a.c1), a.c2 + f * (b.c2 - a.c2)};
}

// A point seen at depth w stays where it is while the place on the pupil moves by du: with Q = position + w *
// tangent, dQ/dx dx + dQ/du du = 0.
glm::dmat2 slopeMatrix(const ScenePath& path, double inverseDepth) {
    const auto column = [&](std::size_t i) {
        return path.change[i].tangent + inverseDepth * path.change[i].position;
    };
    return -(glm::inverse(glm::dmat2(column(0), column(1))) * glm::dmat2(column(2), column(3)));
}

SlopeFit fitSlopes(const CompoundLens& camera, double nearDepth, double farDepth) {
    SlopeFit fit;
    // Only as far out as there is light.
    const double reachMm = std::min(camera.pupil().imageRadius(), camera.pupil().filmRadius());
    fit.radiusPx = reachMm / camera.millimetresPerPixel();
    LineFit whole;
    for (int k = 0; k < kRadii; ++k) {
        const double px = fit.radiusPx * k / (kRadii - 1), r = px * camera.millimetresPerPixel();
        const double light = camera.pupil().irradiance(r);
        LineFit line;
        for (int i = 0; i < kLensSide * kLensSide; ++i) {
            const glm::vec2 disc = concentricDisc((float(i % kLensSide) + 0.5f) / kLensSide,
                                                  (float(i / kLensSide) + 0.5f) / kLensSide);
            const auto path = camera.path(camera.filmCentre() + glm::dvec2(px, 0),
                                          camera.pupil().at(r, disc) / camera.pupil().radius());
            if (!(light > 0) || !path) continue;
            for (int d = 0; d < kDepths; ++d) {
                const double q = 1 / farDepth + (1 / nearDepth - 1 / farDepth) * d / (kDepths - 1);
                const glm::dmat2 slope = slopeMatrix(*path, q);
                const glm::dvec2 s(slope[0][0], slope[1][1]);
                line.add(q, s, 1);
                if (px <= glm::length(camera.filmCentre()))
                    whole.add(q, glm::dvec2((s.x + s.y) / 2), px * light);
            }
        }
        // Where nothing gets through, the last value is as good as any.
        fit.byRadius.push_back(line.count > 0 || k == 0 ? line.result() : fit.byRadius.back());
    }
    fit.whole = whole.result();
    return fit;
}

} // namespace slant
