#include "camera/slope_residual.h"

#include "camera/disc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace slant {
namespace {

constexpr int kFieldRadii = 9;
constexpr int kLensSide = 6; ///< 36 lens positions
constexpr int kNewtonSteps = 20;
constexpr double kNewtonEndPx = 1e-7;

/// A point seen through one lens position.
struct Sighting {
    glm::dvec2 raster, lens;
    glm::dmat2 slope{}; ///< there
    SceneRay sceneRay{};
};

/// Finds the raster position at which the target is seen, by Newton's method from a guess.
bool find(const CompoundLens& camera, const ScenePath::Line& target, double inverseDepth, Sighting& seen) {
    for (int step = 0; step < kNewtonSteps; ++step) {
        const std::optional<ScenePath> path = camera.path(seen.raster, seen.lens);
        if (!path) return false;
        const auto across = [&](const ScenePath::Line& l) { return l.tangent + inverseDepth * l.position; };
        const glm::dmat2 change(across(path->change[0]), across(path->change[1]));
        const glm::dvec2 error = glm::inverse(change) * (across(path->line) - across(target));
        seen.raster -= error;
        if (glm::length(error) > kNewtonEndPx) continue;
        seen.slope = slopeMatrix(*path, inverseDepth);
        return true;
    }
    return false;
}

/// The place in the unit disc that stands for one on the exit pupil, by Newton's method; nothing outside.
std::optional<glm::dvec2> discPlace(const CompoundLens& camera, const Sighting& seen) {
    constexpr double kStep = 1e-3, kEnd = 1e-5;
    const glm::dvec2 offset = seen.raster - camera.filmCentre();
    const double px = glm::length(offset), r = px * camera.millimetresPerPixel();
    const glm::dvec2 e = px > 0 ? offset / px : glm::dvec2(1, 0);
    const glm::dmat2 frame(e, glm::dvec2(-e.y, e.x));
    const glm::dvec2 target = glm::transpose(frame) * seen.lens * camera.pupil().radius();
    glm::dvec2 disc = (target - camera.pupil().at(r, {0, 0})) / camera.pupil().radius();
    for (int step = 0; step < kNewtonSteps; ++step) {
        const glm::dvec2 here = camera.pupil().at(r, disc), error = here - target;
        if (glm::length(error) < kEnd * camera.pupil().radius()) return frame * disc;
        const glm::dmat2 change((camera.pupil().at(r, disc + glm::dvec2(kStep, 0)) - here) / kStep,
                                (camera.pupil().at(r, disc + glm::dvec2(0, kStep)) - here) / kStep);
        disc -= glm::inverse(change) * error;
        const double length = glm::length(disc);
        if (!std::isfinite(length)) break;
        if (length > 0.999) disc *= 0.99 / length;
    }
    return std::nullopt;
}

using Sightings = std::array<std::optional<Sighting>, kLensSide * kLensSide>;

/// The sightings of the point at that depth that is seen px from the middle through the pupil's centre.
Sightings sightings(const CompoundLens& camera, double px, double inverseDepth) {
    const double radius = camera.pupil().radius(), r = px * camera.millimetresPerPixel();
    const glm::dvec2 raster = camera.filmCentre() + glm::dvec2(px, 0);
    const glm::dvec2 centre = camera.pupil().at(r, {0, 0}) / radius;
    const std::optional<ScenePath> chief = camera.path(raster, centre);
    Sightings found;
    if (!chief) return found;
    const glm::dmat2 slope = slopeMatrix(*chief, inverseDepth);
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto unit = [](std::size_t k) { return float(k) / (kLensSide - 1) * 0.998f + 0.001f; };
        const glm::dvec2 disc = concentricDisc(unit(i % kLensSide), unit(i / kLensSide));
        const glm::dvec2 lens = camera.pupil().at(r, disc) / radius;
        Sighting seen{raster + slope * (lens - centre), lens};
        if (!find(camera, chief->line, inverseDepth, seen)) continue;
        if (const auto place = discPlace(camera, seen))
            seen.sceneRay = camera.lensMap().at(seen.raster, *place);
        found[i] = seen;
    }
    return found;
}

Residual residualOf(std::vector<double>& errors) {
    if (errors.empty()) return {};
    std::sort(errors.begin(), errors.end());
    return {errors[std::size_t(0.95 * double(errors.size() - 1))], errors.back()};
}

/// Radial and tangential slopes at a raster position, as a matrix.
glm::dmat2 radialMatrix(const CompoundLens& camera, const SlopeFit& fit, glm::dvec2 raster,
                        double inverseDepth) {
    const glm::dvec2 offset = raster - camera.filmCentre();
    const double r = glm::length(offset);
    const glm::dvec2 e = r > 0 ? offset / r : glm::dvec2(1, 0);
    const glm::dmat2 frame(e, glm::dvec2(-e.y, e.x));
    const glm::dvec2 slopes = fit.at(SlopeFitKind::filmRadius, r).at(inverseDepth);
    return frame * glm::dmat2(slopes.x, 0, 0, slopes.y) * glm::transpose(frame);
}

glm::dmat2 isotropic(const glm::dmat2& m) {
    return glm::dmat2((m[0][0] + m[1][1]) / 2);
}

DepthResiduals residualsAt(const CompoundLens& camera, const SlopeFit& fit, double depth) {
    const double q = 1 / depth, focus = 1 / camera.focusDepth();
    DepthResiduals result;
    result.depth = depth;
    std::array<std::vector<double>, 6> errors;
    std::vector<double> sceneErrors;
    const double slope = double(camera.slopeModel().c1) * q + double(camera.slopeModel().c2);
    for (int k = 0; k < kFieldRadii; ++k) {
        const double px = glm::length(camera.filmCentre()) * k / (kFieldRadii - 1);
        const Sightings all = sightings(camera, px, q), sharp = sightings(camera, px, focus);
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!all[i] || !sharp[i]) continue;
            const glm::dmat2 radial = radialMatrix(camera, fit, all[i]->raster, q);
            const glm::dmat2 inFocus = radialMatrix(camera, fit, sharp[i]->raster, focus);
            result.blurPx = std::max(result.blurPx, std::abs(radial[0][0]));
            for (std::size_t j = 0; j < all.size(); ++j) {
                if (!all[j] || !sharp[j]) continue;
                const glm::dvec2 step = all[j]->lens - all[i]->lens;
                const glm::dvec2 truth = all[j]->raster - all[i]->raster;
                const glm::dvec2 aberration = sharp[j]->raster - sharp[i]->raster - inFocus * step;
                const std::array<glm::dvec2, 6> predicted{
                    fit.whole.at(q).x * step,   isotropic(radial) * step,        radial * step,
                    radial * step + aberration, isotropic(all[i]->slope) * step, all[i]->slope * step};
                for (std::size_t m = 0; m < predicted.size(); ++m)
                    errors[m].push_back(glm::length(truth - predicted[m]));
                const SceneRay &from = all[i]->sceneRay, &to = all[j]->sceneRay;
                if (!(from.weight > 0 && to.weight > 0)) continue;
                const glm::dvec2 off = glm::dvec2(to.xy - from.xy) - slope * glm::dvec2(to.uv - from.uv);
                const glm::dvec3 m = to.filmMetric;
                sceneErrors.push_back(
                    glm::length(glm::dvec2(m.x * off.x + m.y * off.y, m.y * off.x + m.z * off.y)));
            }
        }
    }
    const std::array<Residual*, 6> slots{&result.lens,      &result.radiusMean, &result.radius,
                                         &result.corrected, &result.sampleMean, &result.sample};
    for (std::size_t m = 0; m < slots.size(); ++m) *slots[m] = residualOf(errors[m]);
    result.scene = residualOf(sceneErrors);
    return result;
}

} // namespace

std::vector<DepthResiduals> slopeResiduals(const CompoundLens& camera, double nearDepth, double farDepth) {
    const SlopeFit fit = fitSlopes(camera, nearDepth, farDepth);
    std::vector<DepthResiduals> result{residualsAt(camera, fit, nearDepth)};
    const double focus = camera.focusDepth();
    if (focus > nearDepth && focus < farDepth) result.push_back(residualsAt(camera, fit, focus));
    result.push_back(residualsAt(camera, fit, farDepth));
    return result;
}

double worstResidual(const std::vector<DepthResiduals>& residuals, SlopeFitKind fit) {
    constexpr std::array kOf{&DepthResiduals::lens, &DepthResiduals::radiusMean, &DepthResiduals::sampleMean};
    double worst = 0;
    for (const DepthResiduals& at : residuals)
        worst = std::max(worst, (at.*kOf[std::size_t(fit)]).percentile95);
    return worst;
}

SlopeFitKind selectSlopeFit(const std::vector<DepthResiduals>& residuals, double tolerancePx) {
    SlopeFitKind best = SlopeFitKind::lens;
    for (const SlopeFitKind fit : {SlopeFitKind::lens, SlopeFitKind::filmRadius, SlopeFitKind::sample}) {
        if (worstResidual(residuals, fit) <= tolerancePx) return fit;
        if (worstResidual(residuals, fit) < worstResidual(residuals, best)) best = fit;
    }
    return best;
}

} // namespace slant
