#include "trace/surface.h"

#include <cmath>

namespace slant {

void requireInvertible(const glm::dmat4& matrix, const FileLocation& location) {
    double determinant = glm::determinant(glm::dmat3(matrix));
    glm::dvec3 offset(matrix[3]);
    if (!std::isfinite(determinant) || determinant == 0 || !std::isfinite(offset.x + offset.y + offset.z))
        throw badInput(location, "the transform is singular or not finite");
}

bool flipsNormals(const Shape& shape) {
    bool mirrors = glm::determinant(glm::dmat3(shape.worldFromObject.at[0])) < 0;
    return shape.reverseOrientation != mirrors;
}

} // namespace slant
