// What turns about the z axis to make a sphere, a hyperboloid (so a cylinder or a cone) or a paraboloid: a
// curve on which x² + y² = a z² + b z + c.
#pragma once
#include "scene/scene.h"

namespace slant {

struct Profile {
    Profile() = default;
    /// Of any shape but meshes and disks.
    explicit Profile(const Shape& shape);

    double a = 0, b = 0, c = 0;
    double fromZ = 0, toZ = 0;       ///< where v is 0 and 1; of spheres the lowest and the highest z
    double phiMax = 0;               ///< radians
    double radius = 0;               ///< the greatest
    glm::dvec2 from{1, 0}, to{1, 0}; ///< x and y there before the curve turns

    double lowZ() const { return std::min(fromZ, toZ); }
    double highZ() const { return std::max(fromZ, toZ); }
    double vAt(double z) const { return (z - fromZ) / (toZ - fromZ); }
    double radiusAt(double z) const { return std::sqrt(std::max(0.0, (a * z + b) * z + c)); }
    /// The radius times its derivative in z.
    double steepnessAt(double z) const { return a * z + b / 2; }
    /// Area per radian and unit of z.
    double areaElement(double z) const { return std::hypot(radiusAt(z), steepnessAt(z)); }
    /// By how far the curve has turned to get to a point, from 0 to 2 pi.
    double phiOf(glm::dvec3 p) const;
    glm::dvec3 point(double z, double phi) const;
    /// To the side of dpdu x dpdv; of any length, 0 at the tip of a cone.
    glm::dvec3 normalAt(glm::dvec3 p) const {
        return (toZ < fromZ ? -1.0 : 1.0) * glm::dvec3(p.x, p.y, -steepnessAt(p.z));
    }
    /// Derivative in v at a point off the axis.
    glm::dvec3 dpdv(glm::dvec3 p) const;
    /// Where the line of a hyperboloid passes z before it turns; of others the direction of that alone.
    glm::dvec2 curveAt(double z) const { return glm::mix(from, to, vAt(z)); }
};

} // namespace slant
