// The exit pupil of a lens as it is seen from each place of the film: where rays get through, exactly, all
// clear diameters counted.
//
// Outlines are kept for a series of film radii, each as the rim points of sectors of equal area around the
// pupil's centre of mass. A point of the unit square is mapped to the same place of two of them, so that
// points are spread evenly over the true pupil and none is lost; only what interpolation puts a hair outside
// is blocked. The plane on which the pupil is described is the one where it moves least as the film point
// moves, the exit pupil proper.
#pragma once
#include "camera/lens_system.h"

#include <glm/glm.hpp>
#include <vector>

namespace slant {

class ExitPupil {
public:
    /// For film points up to `filmRadius` from the axis, in the plane z = filmZ.
    ExitPupil(const LensSystem& lens, double filmZ, double filmRadius);

    struct Point {
        glm::dvec2 position; ///< on the pupil plane
        glm::dvec2 centre;   ///< of the pupil seen from there
        double area;         ///< of that pupil, mm^2; 0: no ray gets through
    };
    /// For the film point (-r, 0) with 0 <= r: `square` in [0, 1)^2 is mapped as concentricDisc does.
    Point sample(double r, glm::vec2 square) const;

    double filmRadius() const { return filmRadius_; }
    double planeZ() const { return planeZ_; }
    /// The largest distance from the axis of any pupil on its plane.
    double radius() const { return radius_; }
    /// Film radius from which on no light comes in; infinity if that is beyond filmRadius.
    double imageRadius() const;

private:
    static constexpr int kSectors = 128;

    struct Outline {
        glm::dvec2 centre{0};
        double area = 0;
        std::vector<glm::dvec2> rim; ///< kSectors + 1 points, relative to the centre
    };

    void choosePlane(double filmZ);

    double filmRadius_;
    double planeZ_ = 0, radius_ = 0;
    std::vector<Outline> outlines_; ///< by film radius, evenly spaced from 0 to filmRadius
};

} // namespace slant
