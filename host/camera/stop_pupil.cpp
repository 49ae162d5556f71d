#include "camera/stop_pupil.h"

#include <array>
#include <numbers>
#include <optional>

namespace slant {
namespace {

constexpr int kNewtonSteps = 20;
constexpr double kNewtonEnd = 1e-9; ///< of the stop's radius

/// Rays from one film point to the stop, through points of the exit pupil's plane.
class StopProbe {
public:
    StopProbe(const LensSystem& lens, glm::dvec3 film, double planeZ)
        : lens_(lens), film_(film), planeZ_(planeZ), stopRadius_(lens.stopRadius()) {}

    /// The node of a place on the stop, from the plane's place of one nearby.
    std::optional<StopPupil::Node> node(glm::dvec2 stop, glm::dvec2 guess) const {
        glm::dvec2 place = guess;
        for (int step = 0; step < kNewtonSteps; ++step) {
            const glm::dvec3 way = glm::dvec3(place, planeZ_) - film_;
            const double distance = glm::length(way);
            LensRay ray{film_, way / distance};
            std::array<LensRayDerivative, 2> moved; // along x, y of the plane
            for (int i = 0; i < 2; ++i) {
                glm::dvec3 along(0);
                along[i] = 1;
                moved[std::size_t(i)].direction =
                    (along - ray.direction * glm::dot(ray.direction, along)) / distance;
            }
            if (!lens_.traceToStop(ray, moved)) return std::nullopt;
            const glm::dmat2 change(glm::dvec2(moved[0].origin), glm::dvec2(moved[1].origin));
            const glm::dvec2 error = stopRadius_ * stop - glm::dvec2(ray.origin);
            if (glm::length(error) <= kNewtonEnd * stopRadius_) return seen(place, glm::determinant(change));
            place += glm::inverse(change) * error;
        }
        return std::nullopt;
    }

private:
    /// `magnification`: area on the stop of one on the plane.
    std::optional<StopPupil::Node> seen(glm::dvec2 place, double magnification) const {
        const glm::dvec3 way = glm::dvec3(place, planeZ_) - film_;
        LensRay ray{film_, glm::normalize(way)};
        const std::optional<double> clearance = lens_.traceBesideRims(ray);
        if (!clearance) return std::nullopt;
        const double square = glm::dot(way, way), area = std::numbers::pi * stopRadius_ * stopRadius_;
        return StopPupil::Node{place, way.z * way.z / (square * square) * area / std::abs(magnification),
                               *clearance};
    }

    const LensSystem& lens_;
    glm::dvec3 film_;
    double planeZ_, stopRadius_;
};

/// The share of a ring's nodes that is open, by area.
double shareOf(std::span<const StopPupil::Node> nodes) {
    double open = 0, all = 0;
    for (int turn = 0; turn < PupilNodes::kTurns; ++turn) {
        const glm::dvec2 a = PupilNodes::direction(turn), b = PupilNodes::direction(turn + 1);
        const double angle = a.x * b.y - a.y * b.x;
        for (int distance = 1; distance <= PupilNodes::kDistances; ++distance) {
            const double area = angle * (distance == PupilNodes::kDistances ? distance / 2.0 : distance);
            all += area;
            open +=
                nodes[std::size_t(turn * (PupilNodes::kDistances + 1) + distance)].clearance >= 0 ? area : 0;
        }
    }
    return open / all;
}

} // namespace

StopPupil::StopPupil(const LensSystem& lens, double filmZ, const ExitPupil& pupil)
    : filmRadius_(pupil.filmRadius()) {
    constexpr int kRow = PupilNodes::kDistances + 1;
    glm::dvec2 centre(0);
    for (int ring = 0; ring < PupilNodes::kRings; ++ring) {
        const StopProbe probe(lens, {-pupil.ringRadius(ring), 0, filmZ}, pupil.planeZ());
        const std::size_t first = nodes_.size();
        for (int turn = 0; turn <= PupilNodes::kTurns; ++turn) {
            Node last;
            last.place = centre;
            bool reached = true;
            glm::dvec2 step(0);
            for (int distance = 0; distance < kRow; ++distance) {
                const double share = double(distance) / PupilNodes::kDistances;
                const std::optional<Node> node =
                    reached ? probe.node(share * PupilNodes::direction(turn), last.place + step)
                            : std::nullopt;
                reached = node.has_value();
                if (node) {
                    step = distance > 0 ? node->place - last.place : glm::dvec2(0);
                    last = *node;
                } else { // like its neighbour, but dark
                    last.clearance = -1;
                }
                nodes_.push_back(last);
            }
        }
        centre = nodes_[first].place;
        openShares_.push_back(shareOf(std::span(nodes_).subspan(first)));
    }
}

const StopPupil::Node& StopPupil::node(int ring, int turn, int distance) const {
    return nodes_[std::size_t((ring * (PupilNodes::kTurns + 1) + turn) * (PupilNodes::kDistances + 1) +
                              distance)];
}

glm::dvec2 StopPupil::at(double r, glm::dvec2 stop) const {
    const double rings = std::min(r / filmRadius_, 1.0) * (PupilNodes::kRings - 1);
    return PupilNodes::placeAt(
        rings, stop, [&](int ring, int turn, int distance) { return node(ring, turn, distance).place; });
}

} // namespace slant
