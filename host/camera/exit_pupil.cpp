#include "camera/exit_pupil.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace slant {
namespace {

constexpr int kFirstScan = 64, kScan = 16; ///< points per side of a coarse search
constexpr int kDirections = 64;            ///< from the centre to the rim, over half a turn
constexpr int kRadialSteps = 16;
constexpr int kRoughBisections = 8, kBisections = 22;
/// Keeps rounding from carrying a ray at the rim over it.
constexpr double kInside = 1 - 1e-9;
/// A pupil farther away than this many times the distance from film to lens stands for one at infinity.
constexpr double kFarthestPlane = 1000;
constexpr int kNodes = (PupilNodes::kTurns + 1) * (PupilNodes::kDistances + 1);

/// Half a pupil in polar coordinates around a centre on the axis of symmetry.
struct HalfOutline {
    double centre = 0;
    std::vector<double> radii; ///< at angles pi * i / kDirections
};

/// Rays from one film point (-r, 0), through points of the plane z = 0.
class Probe {
public:
    Probe(const LensSystem& lens, double filmZ, double r) : lens_(lens), film_(-r, 0, filmZ) {}

    bool passes(glm::dvec2 p) const {
        LensRay ray{film_, glm::normalize(glm::dvec3(p, 0) - film_)};
        return lens_.traceFromFilm(ray);
    }

    /// Irradiance that a square millimetre of the plane brings: cos^4 / distance^2.
    double light(glm::dvec2 p) const {
        const glm::dvec3 way = glm::dvec3(p, 0) - film_;
        const double z2 = film_.z * film_.z, square = glm::dot(way, way);
        return z2 / (square * square);
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

    /// Distance from a point within the pupil to its rim, a little less than true.
    double rim(double centre, double angle, double reach, int bisections) const {
        const glm::dvec2 outwards(std::cos(angle), std::sin(angle));
        double inside = 0, outside = reach;
        for (int step = 0; step < bisections; ++step) {
            const double middle = (inside + outside) / 2;
            (passes(glm::dvec2(centre, 0) + middle * outwards) ? inside : outside) = middle;
        }
        return kInside * inside;
    }

    HalfOutline outline(double centre, double reach, int bisections) const {
        HalfOutline half{centre, {}};
        for (int i = 0; i <= kDirections; ++i)
            half.radii.push_back(rim(centre, std::numbers::pi * i / kDirections, reach, bisections));
        return half;
    }

private:
    const LensSystem& lens_;
    glm::dvec3 film_;
};

/// Centre of mass.
double middleOf(const HalfOutline& half) {
    double area = 0, moment = 0;
    for (int i = 0; i <= kDirections; ++i) {
        const double end = i == 0 || i == kDirections ? 0.5 : 1, r = half.radii[std::size_t(i)];
        area += end * r * r / 2;
        moment += end * r * r * r / 3 * std::cos(std::numbers::pi * i / kDirections);
    }
    return half.centre + (area > 0 ? moment / area : 0);
}

/// The light that comes in along one direction from the centre, in a sector of one radian.
class Sector {
public:
    Sector(const Probe& probe, double centre, double angle, double rim)
        : centre_(centre, 0), outwards_(std::cos(angle), std::sin(angle)), step_(rim / kRadialSteps) {
        for (std::size_t k = 0; k < kRadialSteps; ++k) {
            density_[k] = probe.light(at((double(k) + 0.5) * step_));
            sums_[k + 1] = sums_[k] + density_[k] * step_ * step_ * (double(k) + 0.5);
        }
    }
    double total() const { return sums_.back(); }

    /// The point up to which a share of the light lies nearer to the centre.
    glm::dvec2 upTo(double share) const {
        const double target = share * total();
        std::size_t k = 0;
        while (k + 1 < kRadialSteps && sums_[k + 1] < target) ++k;
        const double inner = double(k) * step_;
        const double outer2 = inner * inner + (density_[k] > 0 ? 2 * (target - sums_[k]) / density_[k] : 0);
        return at(std::sqrt(outer2));
    }

private:
    glm::dvec2 at(double radius) const { return centre_ + radius * outwards_; }

    glm::dvec2 centre_, outwards_;
    double step_;
    std::array<double, kRadialSteps> density_{};
    std::array<double, kRadialSteps + 1> sums_{};
};

/// Light of the sectors up to each direction, of half a pupil.
std::vector<double> lightUpTo(const Probe& probe, const HalfOutline& half) {
    std::vector<double> sums{0};
    double before = 0;
    for (int i = 0; i <= kDirections; ++i) {
        const double angle = std::numbers::pi * i / kDirections;
        const double here = Sector(probe, half.centre, angle, half.radii[std::size_t(i)]).total();
        if (i > 0) sums.push_back(sums.back() + std::numbers::pi / kDirections * (before + here) / 2);
        before = here;
    }
    return sums;
}

std::vector<glm::dvec2> nodesOf(const Probe& probe, const HalfOutline& half,
                                const std::vector<double>& light) {
    std::vector<glm::dvec2> nodes;
    nodes.reserve(kNodes);
    std::size_t i = 0;
    for (int turn = 0; turn <= PupilNodes::kTurns; ++turn) {
        const glm::dvec2 direction = PupilNodes::direction(turn);
        const double target = light.back() * std::atan2(direction.y, direction.x) / std::numbers::pi;
        while (i + 1 < kDirections && light[i + 1] < target) ++i;
        const double f = std::clamp((target - light[i]) / (light[i + 1] - light[i]), 0.0, 1.0);
        const double angle = std::numbers::pi * (double(i) + f) / kDirections;
        const double reach = 1.5 * std::max(half.radii[i], half.radii[i + 1]);
        const Sector sector(probe, half.centre, angle, probe.rim(half.centre, angle, reach, kBisections));
        for (int distance = 0; distance <= PupilNodes::kDistances; ++distance) {
            const double share = double(distance) / PupilNodes::kDistances;
            nodes.push_back(sector.upTo(share * share));
        }
    }
    return nodes;
}

} // namespace

glm::dvec2 PupilNodes::direction(int turn) {
    const double t = 2.0 * turn / kTurns;
    return glm::normalize(glm::dvec2(1 - t, t <= 1 ? t : 2 - t));
}

ExitPupil::ExitPupil(const LensSystem& lens, double filmZ, double filmRadius)
    : filmRadius_(filmRadius), rings_(PupilNodes::kRings) {
    const double widest =
        1.5 * lens.rearRadius(); // at z = 0 rays may be farther out than at the rear surface
    glm::dvec2 low(-widest), high(widest);
    for (int k = 0; k < PupilNodes::kRings; ++k) {
        const Probe probe(lens, filmZ, ringRadius(k));
        const std::optional<glm::dvec2> found = probe.scan(low, high, k == 0 ? kFirstScan : kScan);
        if (!found) break; // and stays so farther out
        const HalfOutline half = probe.outline(
            middleOf(probe.outline(found->x, 2 * widest, kRoughBisections)), 2 * widest, kBisections);
        const std::vector<double> light = lightUpTo(probe, half);
        if (!(light.back() > 0)) break;
        rings_[std::size_t(k)] = {2 * light.back(), nodesOf(probe, half, light)};

        low = high = {half.centre, 0};
        for (const glm::dvec2& p : rings_[std::size_t(k)].nodes) {
            low = glm::min(low, glm::dvec2(p.x, -p.y));
            high = glm::max(high, p);
        }
        const glm::dvec2 margin = 0.3 * (high - low) + 1e-3 * widest;
        low -= margin;
        high += margin;
    }
    choosePlane(filmZ);
}

/// Seen from the film, another plane shows the pupils magnified. Its distance is fitted so that their centres
/// are nearest to the axis, each weighted by its light.
void ExitPupil::choosePlane(double filmZ) {
    double product = 0, square = 0;
    for (int k = 0; k < PupilNodes::kRings; ++k) {
        const Ring& ring = rings_[std::size_t(k)];
        if (ring.nodes.empty()) break;
        const double offset = ring.nodes[0].x + ringRadius(k);
        product += ring.irradiance * ringRadius(k) * offset;
        square += ring.irradiance * offset * offset;
    }
    double scale = square > 0 ? product / square : kFarthestPlane;
    if (!(scale > 0 && scale < kFarthestPlane)) scale = kFarthestPlane;
    planeZ_ = filmZ * (1 - scale);
    glm::dvec2 last(0);
    for (int k = 0; k < PupilNodes::kRings; ++k) {
        Ring& ring = rings_[std::size_t(k)];
        const glm::dvec2 film(-ringRadius(k), 0);
        for (glm::dvec2& p : ring.nodes) {
            p = film + scale * (p - film);
            radius_ = std::max(radius_, glm::length(p));
        }
        // Where it has vanished it is a point at its last place.
        if (ring.nodes.empty()) ring.nodes.assign(kNodes, last);
        last = ring.nodes[0];
    }
}

double ExitPupil::imageRadius() const {
    for (int k = 0; k < PupilNodes::kRings; ++k)
        if (rings_[std::size_t(k)].irradiance == 0) return ringRadius(k);
    return std::numeric_limits<double>::infinity();
}

glm::dvec2 ExitPupil::node(int ring, int turn, int distance) const {
    return rings_[std::size_t(ring)].nodes[std::size_t(turn * (PupilNodes::kDistances + 1) + distance)];
}

double ExitPupil::irradiance(double r) const {
    const double place = r / filmRadius_ * (PupilNodes::kRings - 1);
    if (!(place < PupilNodes::kRings - 1)) return 0;
    const std::size_t k = std::size_t(place);
    const double a = std::sqrt(rings_[k].irradiance), b = std::sqrt(rings_[k + 1].irradiance);
    const double diameter = a + (place - double(k)) * (b - a);
    return diameter * diameter;
}

glm::dvec2 ExitPupil::at(double r, glm::dvec2 disc) const {
    const double rings = std::min(r / filmRadius_, 1.0) * (PupilNodes::kRings - 1);
    return PupilNodes::placeAt(rings, disc,
                               [&](int ring, int turn, int distance) { return node(ring, turn, distance); });
}

} // namespace slant
