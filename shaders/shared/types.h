// Types of the headers that C++ and GLSL share: on the C++ side GLM's, under the names that GLSL gives them.
#ifndef SLANT_SHARED_TYPES_H
#define SLANT_SHARED_TYPES_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>

namespace slant {
using uint = std::uint32_t;
using glm::ivec2;
using glm::uvec2;
using glm::vec2;
using glm::vec3;
using glm::vec4;
} // namespace slant
#define SLANT_SHARED_BEGIN namespace slant {
#define SLANT_SHARED_END }
#else
#define SLANT_SHARED_BEGIN
#define SLANT_SHARED_END
#endif

#endif
