// Perlin's gradient noise (2002, "Improving Noise") and sums of it, as pbrt-v4 has them, without filtering.
#pragma once
#include <glm/glm.hpp>

namespace slant {

/// Smooth, in [-1, 1], 0 at points of whole numbers.
float noise(glm::vec3 p);
/// Octaves of noise, each 1.99 times as fine and `roughness` times as strong as the one before.
float fractalNoise(glm::vec3 p, float roughness, int octaves);
/// The same of its absolute value.
float turbulence(glm::vec3 p, float roughness, int octaves);

/// pbrt's marble: veins along y, of `variation` times fractal noise.
glm::vec3 marble(glm::vec3 p, float variation, float roughness, int octaves);
/// Whether pbrt has a polka dot there.
bool isInDot(glm::vec2 st);

} // namespace slant
