// Types of the headers that C++ and GLSL share: on the C++ side GLM's, under the names that GLSL gives them.
// Structs of push constants follow the std430 rules on both sides: a vec3 or vec4 begins at a multiple of 16
// bytes, a vec2 of 8, and a struct ends without padding (tests/unit/layout_test.cpp checks each).
#ifndef SLANT_SHARED_TYPES_H
#define SLANT_SHARED_TYPES_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>

namespace slant {
using uint = std::uint32_t;
using glm::ivec2;
using glm::ivec4;
using glm::uvec2;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
} // namespace slant
#define SLANT_SHARED_BEGIN namespace slant {
#define SLANT_SHARED_END }
#define SLANT_SHARED_CONSTANT inline constexpr
#define SLANT_SHARED_FUNCTION inline
#else
#define SLANT_SHARED_BEGIN
#define SLANT_SHARED_END
#define SLANT_SHARED_CONSTANT const
#define SLANT_SHARED_FUNCTION
#endif

#endif
