// The exit pupil of a lens by places on its stop: where the rays through each of them reach the film, for
// openings of other shapes than the disc.
//
// Unlike the disc of exit_pupil.h, which stands for what is left of a pupil at each film point, that of the
// stop is the same for all, so that a shape can be laid upon it. So rays weigh differently: by what a place
// of the stop gives the film in irradiance; and there are places from which no ray gets there, because of
// the rims of other surfaces.
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

    /// As ExitPupil::at.
    glm::dvec2 at(double r, glm::dvec2 stop) const;
    const Node& node(int ring, int turn, int distance) const;
    /// The share of the stop from which light comes.
    double openShare(int ring) const { return openShares_[std::size_t(ring)]; }

private:
    double filmRadius_;
    std::vector<Node> nodes_; ///< [ring][turn][distance]
    std::vector<double> openShares_;
};

} // namespace slant
