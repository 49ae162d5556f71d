// The exit pupil of a lens as it is seen from each place of the film: where rays get through, exactly, all
// clear diameters counted.
//
// It is mapped from the unit disc, for a series of film radii: nodes at directions and distances of the disc
// each have their place on the pupil, such that equal areas of the disc receive equal shares of the light
// that comes through the pupil (cos^4 counted). So places spread evenly over the disc need no weights, none
// is lost, and only what interpolation puts a hair outside is blocked. The plane on which the pupil is
// described is the one where it moves least as the film point moves, the exit pupil proper.
#pragma once
#include "camera/lens_system.h"

#include <glm/glm.hpp>
#include <vector>

namespace slant {

/// Nodes of the unit disc. Directions are counted over half a turn by the sum norm, which needs no
/// trigonometry: (x, y) with y >= 0 and |x| + y = 1 is in direction 1 - x of 0 to 2.
struct PupilNodes {
    static constexpr int kRings = 64, kTurns = 64, kDistances = 16; ///< intervals of the last two
    /// Between direction and distance nodes, of one quarter or the other: unit vector of a direction node.
    static glm::dvec2 direction(int turn);
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
    /// Film radius from which on no light comes in; infinity if that is beyond filmRadius.
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
