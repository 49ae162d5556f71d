// The opening through which an infinite light shines, as pbrt-v4 has it: a rectangle, which light passes to
// one side alone. Where its walls are is not asked: whoever looks past it sees no light.
#pragma once
#include "base/error.h"
#include "trace/warp.h"

#include <array>

namespace slant {

class Portal {
public:
    /// Four corners in a row, world space. Throws Error(badInput) at `where` unless they form a rectangle.
    Portal(const std::array<glm::vec3, 4>& corners, const FileLocation& where);

    /// Whether a ray from there, of unit direction, sees through it.
    bool shows(glm::vec3 origin, glm::vec3 direction) const { return pdf(origin, direction) > 0; }
    /// A direction through a point of it, evenly over its area.
    glm::vec3 sample(glm::vec3 origin, glm::vec2 u) const;
    /// Density of that over solid angle; 0 where a ray does not see through it.
    float pdf(glm::vec3 origin, glm::vec3 direction) const;

private:
    glm::vec3 corner_, edge1_, edge2_, normal_; ///< light goes against the normal
    float area_;
};

} // namespace slant
