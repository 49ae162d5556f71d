#include "camera/exit_pupil.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace slant {
namespace {

constexpr int kFilmRadii = 64;
constexpr int kFirstScan = 64, kScan = 16; ///< points along one side of a coarse search
constexpr int kDirections = 64;            ///< from the centre to the rim, over half a turn
constexpr int kRoughBisections = 8, kBisections = 22;
/// A pupil further off than this many distances from film to lens stands for one at infinity.
constexpr double kFarthestPlane = 1000;

/// Half a pupil in polar coordinates around a centre on the axis of symmetry.
struct HalfOutline {
    double centre = 0;
    std::vector<double> radii; ///< at angles pi * i / kDirections

    glm::dvec2 at(std::size_t i) const {
        const double angle = std::numbers::pi * double(i) / kDirections;
        return {centre + radii[i] * std::cos(angle), radii[i] * std::sin(angle)};
    }
};

/// Rays from one film point (-r, 0), through points of the plane z = 0.
class Probe {
public:
    Probe(const LensSystem& lens, double filmZ, double r) : lens_(lens), film_(-r, 0, filmZ) {}

    bool passes(glm::dvec2 p) const {
        LensRay ray{film_, glm::normalize(glm::dvec3(p, 0) - film_)};
        return lens_.traceFromFilm(ray);
    }

    /// Centre of what passes among points spread over a box; half of it, for the sake of symmetry.
    std::optional<glm::dvec2> scan(glm::dvec2 low, glm::dvec2 high, int side) const {
        glm::dvec2 sum(0);
        int count = 0;
        for (int i = 0; i < side; ++i)
            for (int j = 0; j < side / 2; ++j) {
                const glm::dvec2 p(low.x + (high.x - low.x) * (i + 0.5) / side,
                                   high.y * (j + 0.5) / (side / 2));
                if (!passes(p)) continue;
                sum += p;
                ++count;
            }
        if (count == 0) return std::nullopt;
        return sum / double(count);
    }

    /// From a point within the pupil outwards.
    HalfOutline outline(double centre, double reach, int bisections) const {
        HalfOutline half{centre, {}};
        for (int i = 0; i <= kDirections; ++i) {
            const double angle = std::numbers::pi * i / kDirections;
            const glm::dvec2 outwards(std::cos(angle), std::sin(angle));
            double inside = 0, outside = reach;
            for (int step = 0; step < bisections; ++step) {
                const double middle = (inside + outside) / 2;
                (passes(glm::dvec2(centre, 0) + middle * outwards) ? inside : outside) = middle;
            }
            half.radii.push_back(inside);
        }
        return half;
    }

private:
    const LensSystem& lens_;
    glm::dvec3 film_;
};

/// Area of the sectors up to each direction, of half a pupil, and the centre of mass.
std::vector<double> sectorAreas(const HalfOutline& half, double& centreOfMass) {
    std::vector<double> sums{0};
    double moment = 0;
    for (std::size_t i = 0; i < kDirections; ++i) {
        const glm::dvec2 a = half.at(i), b = half.at(i + 1);
        // Between two directions the radius squared is taken to be linear: exact for a circle to second
        // order.
        const double area = std::numbers::pi / kDirections *
                            (half.radii[i] * half.radii[i] + half.radii[i + 1] * half.radii[i + 1]) / 4;
        sums.push_back(sums.back() + area);
        moment += area * (half.centre + a.x + b.x) / 3;
    }
    centreOfMass = sums.back() > 0 ? moment / sums.back() : half.centre;
    return sums;
}

} // namespace

ExitPupil::ExitPupil(const LensSystem& lens, double filmZ, double filmRadius)
    : filmRadius_(filmRadius), outlines_(kFilmRadii) {
    const double widest =
        1.5 * lens.rearRadius(); // at z = 0 rays may be further out than at the rear surface
    glm::dvec2 low(-widest), high(widest);
    for (int k = 0; k < kFilmRadii; ++k) {
        const Probe probe(lens, filmZ, filmRadius * k / (kFilmRadii - 1));
        const std::optional<glm::dvec2> found = probe.scan(low, high, k == 0 ? kFirstScan : kScan);
        if (!found) break; // and so it remains further out
        HalfOutline half = probe.outline(found->x, 2 * widest, kRoughBisections);
        double centre = 0;
        sectorAreas(half, centre);
        half = probe.outline(centre, 2 * widest, kBisections);
        const std::vector<double> areas = sectorAreas(half, centre);

        Outline& outline = outlines_[std::size_t(k)];
        outline.centre = {half.centre, 0};
        outline.area = 2 * areas.back();
        std::vector<glm::dvec2> upper;
        std::size_t i = 0;
        for (int j = 0; j <= kSectors / 2; ++j) {
            const double target = areas.back() * 2 * j / kSectors;
            while (i + 1 < kDirections && areas[i + 1] < target) ++i;
            const double f = std::clamp((target - areas[i]) / (areas[i + 1] - areas[i]), 0.0, 1.0);
            const double angle = std::numbers::pi * (double(i) + f) / kDirections;
            const double radius = half.radii[i] + f * (half.radii[i + 1] - half.radii[i]);
            upper.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
        }
        outline.rim = upper;
        for (auto p = upper.rbegin() + 1; p != upper.rend(); ++p) outline.rim.emplace_back(p->x, -p->y);

        low = high = outline.centre;
        for (const glm::dvec2& p : outline.rim) {
            low = glm::min(low, outline.centre + p);
            high = glm::max(high, outline.centre + p);
        }
        const glm::dvec2 margin = 0.3 * (high - low) + 1e-3 * widest;
        low -= margin;
        high += margin;
    }
    choosePlane(filmZ);
}

/// Seen from the film, another plane shows the pupils magnified. Its distance is fitted so that their centres
/// are nearest to the axis, each weighted by its area.
void ExitPupil::choosePlane(double filmZ) {
    double product = 0, square = 0;
    const auto filmX = [&](std::size_t k) { return -filmRadius_ * double(k) / (kFilmRadii - 1); };
    for (std::size_t k = 0; k < outlines_.size(); ++k) {
        const double offset = outlines_[k].centre.x - filmX(k);
        product -= outlines_[k].area * filmX(k) * offset;
        square += outlines_[k].area * offset * offset;
    }
    double scale = square > 0 ? product / square : kFarthestPlane;
    if (!(scale > 0 && scale < kFarthestPlane)) scale = kFarthestPlane;
    planeZ_ = filmZ * (1 - scale);
    for (std::size_t k = 0; k < outlines_.size(); ++k) {
        Outline& outline = outlines_[k];
        const glm::dvec2 film(filmX(k), 0);
        outline.centre = film + scale * (outline.centre - film);
        outline.area *= scale * scale;
        for (glm::dvec2& p : outline.rim) {
            p *= scale;
            radius_ = std::max(radius_, glm::length(outline.centre + p));
        }
        // Where it has just vanished it is a point at its last place.
        if (outline.area == 0 && k > 0 && outlines_[k - 1].area > 0) outline.centre = outlines_[k - 1].centre;
        if (outline.rim.empty()) outline.rim.assign(kSectors + 1, glm::dvec2(0));
    }
}

double ExitPupil::imageRadius() const {
    for (std::size_t k = 0; k < outlines_.size(); ++k)
        if (outlines_[k].area == 0) return filmRadius_ * double(k) / (kFilmRadii - 1);
    return std::numeric_limits<double>::infinity();
}

ExitPupil::Point ExitPupil::sample(double r, glm::vec2 square) const {
    const double place = r / filmRadius_ * (kFilmRadii - 1);
    if (!(place < kFilmRadii - 1)) return {{}, {}, 0};
    const std::size_t k = std::size_t(place);
    const double f = place - double(k);

    // Concentric map of Shirley and Chiu: distance from the centre and angle in turns.
    const double x = 2 * double(square.x) - 1, y = 2 * double(square.y) - 1;
    const bool wide = std::abs(x) > std::abs(y);
    double distance = wide ? x : y;
    double turn = distance == 0 ? 0 : wide ? y / x / 8 : 0.25 - x / y / 8;
    if (distance < 0) turn += 0.5;
    distance = std::abs(distance);
    if (turn < 0) turn += 1;
    const double sector = std::min(turn * kSectors, kSectors - 1e-9);
    const std::size_t j = std::size_t(sector);
    const double g = sector - double(j);

    const auto at = [&](const Outline& o) {
        return o.centre + distance * (o.rim[j] + g * (o.rim[j + 1] - o.rim[j]));
    };
    const Outline &a = outlines_[k], &b = outlines_[k + 1];
    const double diameter = std::sqrt(a.area) + f * (std::sqrt(b.area) - std::sqrt(a.area));
    return {at(a) + f * (at(b) - at(a)), a.centre + f * (b.centre - a.centre), diameter * diameter};
}

} // namespace slant
