// The optics of a lens of spherical surfaces: rays through it, exactly, and its paraxial figures.
//
// Lens space, in millimetres: x to the right and y down as on the raster, z along the axis towards the scene,
// 0 at the vertex of the rear surface. All arithmetic is double: of + - * / and sqrt only, so that every
// processor gives the same bits.
#pragma once
#include "scene/scene.h"

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace slant {

/// `direction` is of unit length.
struct LensRay {
    glm::dvec3 origin, direction;
};

/// How a ray changes with some parameter.
struct LensRayDerivative {
    glm::dvec3 origin{0}, direction{0};
};

/// A pupil, or any other disc on the axis.
struct AxialDisc {
    double z, radius;
};

class LensSystem {
public:
    /// Opens the stop to a diameter. Throws Error(badInput) if the lens forms no image.
    LensSystem(const LensPrescription& lens, double stopDiameterMm);

    /// Follows a ray from the film until it has left the front surface, with its derivatives, if any. False
    /// if it misses a surface, passes outside a clear diameter, or is totally reflected.
    bool traceFromFilm(LensRay& ray, std::span<LensRayDerivative> derivatives = {}) const;
    /// The same, but no clear diameter stops the ray. Returns how far inside all of them but the stop's it
    /// stays, as the least of 1 - (height / clear radius)^2; nothing if it misses a surface or is totally
    /// reflected.
    std::optional<double> traceBesideRims(LensRay& ray, std::span<LensRayDerivative> derivatives = {}) const;
    /// From the film to the plane of the stop, ignoring clear diameters; false in the same cases.
    bool traceToStop(LensRay& ray, std::span<LensRayDerivative> derivatives) const;
    /// As traceFromFilm, but from the scene until the ray has left the rear surface.
    bool traceFromScene(LensRay& ray) const;

    /// For drawings: where a ray from the film begins, meets each surface and reaches the plane z = `front`;
    /// empty if it is blocked.
    std::vector<glm::dvec3> corners(LensRay ray, double front) const;

    double focalLength() const { return focalLength_; }
    double frontVertex() const { return surfaces_.front().vertex; }
    double frontFocus() const { return frontFocus_; }
    double rearFocus() const { return rearFocus_; }
    double frontPrincipal() const { return frontFocus_ - focalLength_; }
    double rearPrincipal() const { return rearFocus_ + focalLength_; }
    AxialDisc entrancePupil() const { return entrancePupil_; }
    AxialDisc exitPupil() const { return exitPupil_; }
    /// Focused at infinity.
    double fNumber() const { return focalLength_ / (2 * entrancePupil_.radius); }
    double stopRadius() const;
    /// Clear radius of the rear surface.
    double rearRadius() const;
    /// Surfaces from front to rear, for drawings: vertex, radius of curvature, clear radius.
    struct Outline {
        double vertex, radius, clearRadius;
        bool glassBehind;
    };
    std::vector<Outline> outline() const;

    /// The nearest distance from the film that can be brought into focus.
    double nearestFocus() const;
    /// Where the film must be for the plane at that distance from it to be in focus, by the principal planes
    /// and the focal length (as pbrt's thick-lens method). Throws Error(badInput) at `where` if there is no
    /// such place behind the rear surface, or if that plane lies within the lens.
    double filmPosition(double focusDistanceMm, const FileLocation& where) const;
    /// The inverse: the distance in focus for a film behind the rear surface. Throws Error(badInput) at
    /// `where` if nothing in front of the lens is.
    double focusDistance(double filmDistanceMm, const FileLocation& where) const;

private:
    struct Surface {
        double vertex, radius;           ///< radius 0: the stop
        double clearRadius2;             ///< squared
        double indexBehind, indexBefore; ///< towards the film, towards the scene
    };

    /// The squared height at which the ray meets the surface; infinity if it does not or is reflected.
    static double pass(const Surface& surface, double eta, LensRay& ray,
                       std::span<LensRayDerivative> derivatives);
    void findCardinalPoints(const std::string& path);
    void findPupils(std::size_t stop);

    std::vector<Surface> surfaces_; ///< front to rear
    double focalLength_ = 0, frontFocus_ = 0, rearFocus_ = 0;
    AxialDisc entrancePupil_{}, exitPupil_{};
};

} // namespace slant
