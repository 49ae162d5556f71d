// The exit pupil of a lens as seen from each place on the film: exactly where rays get through, with all
// clear diameters taken into account.
//
// It is mapped from the unit disc, for a series of film radii: nodes at directions and distances of the disc
// each have their place on the pupil, such that equal areas of the disc receive equal shares of the light
// that comes through the pupil (cos^4 counted). So places spread evenly over the disc need no weights and
// none is lost; only those that interpolation puts slightly outside are blocked. The plane on which the pupil
// is described is the one where it moves least as the film point moves, the exit pupil proper.
#pragma once
#include "camera/lens_system.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

namespace slant {

/// Nodes of the unit disc. Directions are counted over half a turn by the sum norm, which needs no
/// trigonometry: (x, y) with y >= 0 and |x| + y = 1 is in direction 1 - x of 0 to 2.
struct PupilNodes {
    static constexpr int kRings = 64, kTurns = 64, kDistances = 16; ///< intervals of the last two
    /// Between direction and distance nodes, of one quarter or the other: unit vector of a direction node.
    static glm::dvec2 direction(int turn);

    /// Linear between the places node(ring, turn, distance), y >= 0, of nodes; `rings` counts them from 0.
    template <typename Node>
    static glm::dvec2 placeAt(double rings, glm::dvec2 disc, const Node& node) {
        const int ring = std::min(int(rings), kRings - 2);
        const double x = disc.x, y = std::abs(disc.y), norm = std::abs(x) + y;
        const double t = norm > 0 ? 1 - x / norm : 0;
        const double turns = t * (kTurns / 2.0);
        const int turn = std::min(int(turns), kTurns - 1);
        const double distances = std::min(glm::length(disc), 1.0) * kDistances;
        const int distance = std::min(int(distances), kDistances - 1);
        const double f = rings - ring, g = turns - turn, h = distances - distance;
        const auto along = [&](int k, int j) {
            const glm::dvec2 a = node(k, j, distance), b = node(k, j, distance + 1);
            return a + h * (b - a);
        };
        const auto inRing = [&](int k) {
            const glm::dvec2 a = along(k, turn), b = along(k, turn + 1);
            return a + g * (b - a);
        };
        const glm::dvec2 a = inRing(ring), p = a + f * (inRing(ring + 1) - a);
        return {p.x, disc.y < 0 ? -p.y : p.y};
    }
};

class ExitPupil {
public:
    /// For film points up to `filmRadius` from the axis, in the plane z = filmZ.
    ExitPupil(const LensSystem& lens, double filmZ, double filmRadius);

    /// For the film point (-r, 0) with 0 <= r, the place on the pupil plane of one in the unit disc.
    glm::dvec2 at(double r, glm::dvec2 disc) const;
    /// The irradiance of the film there under radiance 1; 0: no ray gets through.
    double irradiance(double r) const;

    /// Place of a node, of film radius filmRadius * ring / (kRings - 1).
    glm::dvec2 node(int ring, int turn, int distance) const;
    double ringRadius(int ring) const { return filmRadius_ * ring / (PupilNodes::kRings - 1); }
    double filmRadius() const { return filmRadius_; }
    double planeZ() const { return planeZ_; }
    /// The largest distance from the axis of any pupil on its plane.
    double radius() const { return radius_; }
    /// Film radius beyond which no light comes in; infinity if that is beyond filmRadius.
    double imageRadius() const;

private:
    struct Ring {
        double irradiance = 0;
        std::vector<glm::dvec2> nodes; ///< [turn][distance], the half with y >= 0
    };

    void choosePlane(double filmZ);

    double filmRadius_;
    double planeZ_ = 0, radius_ = 0;
    std::vector<Ring> rings_;
};

} // namespace slant
