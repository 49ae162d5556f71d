// The exit pupil of a lens by places on its stop: where the rays through each place reach the film, for
// openings that are not discs.
//
// The disc of exit_pupil.h stands for what is left of a pupil at each film point; the disc of the stop is the
// same for all, so that a shape can be placed on it. So rays differ in weight, by the irradiance that a place
// on the stop gives the film; and from some places no ray gets through, because of the rims of other
// surfaces.
#pragma once
#include "camera/exit_pupil.h"

namespace slant {

/// Nodes are those of PupilNodes, in the disc of the stop.
class StopPupil {
public:
    struct Node {
        glm::dvec2 place{0};   ///< on the plane of the exit pupil
        double irradiance = 0; ///< of the film, were all of the stop as bright as seen there
        double clearance = -1; ///< below 0: the ray is blocked (LensSystem::traceBesideRims)
    };

    StopPupil(const LensSystem& lens, double filmZ, const ExitPupil& pupil);

    /// See ExitPupil::at.
    glm::dvec2 at(double r, glm::dvec2 stop) const;
    const Node& node(int ring, int turn, int distance) const;
    /// The share of the stop that light comes from.
    double openShare(int ring) const { return openShares_[std::size_t(ring)]; }

private:
    double filmRadius_;
    std::vector<Node> nodes_; ///< [ring][turn][distance]
    std::vector<double> openShares_;
};

} // namespace slant
