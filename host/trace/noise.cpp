#include "trace/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace slant {
namespace {

/// Perlin's permutation.
constexpr std::array<std::uint8_t, 256> kPermutation = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,
    69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,
    94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174, 20,  125, 136,
    171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231, 83,  111, 229, 122,
    60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143, 54,  65,  25,  63,  161,
    1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196, 135, 130, 116, 188, 159, 86,
    164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124, 123, 5,   202, 38,  147, 118, 126,
    255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,  182, 189, 28,  42,  223, 183, 170, 213,
    119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101, 155, 167, 43,  172, 9,   129, 22,  39,  253,
    19,  98,  108, 110, 79,  113, 224, 232, 178, 185, 112, 104, 218, 246, 97,  228, 251, 34,  242, 193,
    238, 210, 144, 12,  191, 179, 162, 241, 81,  51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,
    181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,
    222, 114, 67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

constexpr float kLacunarity = 1.99f;
/// Beyond it coordinates repeat, so that their cells are whole numbers.
constexpr float kPeriod = 1 << 30;

int permuted(int i) {
    return kPermutation[std::size_t(i & 255)];
}

/// The product of the gradient of a corner and the offset from it.
float slope(glm::ivec3 corner, glm::vec3 d) {
    const int h = permuted(permuted(permuted(corner.x) + corner.y) + corner.z) & 15;
    const float u = h < 8 || h == 12 || h == 13 ? d.x : d.y;
    const float v = h < 4 || h == 12 || h == 13 ? d.y : d.z;
    return (h & 1 ? -u : u) + (h & 2 ? -v : v);
}

} // namespace

float noise(glm::vec3 p) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::fmod(p[axis], kPeriod);
    if (!(glm::dot(p, p) >= 0)) return 0; // not a number
    const glm::vec3 cell = glm::floor(p), d = p - cell;
    const glm::ivec3 corner(cell);
    const glm::vec3 weight = d * d * d * (d * (d * 6.f - 15.f) + 10.f);
    const auto row = [&](int y, int z) {
        return std::lerp(slope(corner + glm::ivec3(0, y, z), d - glm::vec3(0, y, z)),
                         slope(corner + glm::ivec3(1, y, z), d - glm::vec3(1, y, z)), weight.x);
    };
    return std::lerp(std::lerp(row(0, 0), row(1, 0), weight.y), std::lerp(row(0, 1), row(1, 1), weight.y),
                     weight.z);
}

float fractalNoise(glm::vec3 p, float roughness, int octaves) {
    float sum = 0, strength = 1;
    for (int i = 0; i < octaves; ++i, p *= kLacunarity, strength *= roughness) sum += strength * noise(p);
    return sum;
}

float turbulence(glm::vec3 p, float roughness, int octaves) {
    float sum = 0, strength = 1;
    for (int i = 0; i < octaves; ++i, p *= kLacunarity, strength *= roughness)
        sum += strength * std::abs(noise(p));
    return sum;
}

glm::vec3 marble(glm::vec3 p, float variation, float roughness, int octaves) {
    constexpr glm::vec3 kPale(0.58f, 0.58f, 0.6f);
    constexpr std::array<glm::vec3, 9> kColours = {
        kPale, kPale, kPale, glm::vec3(0.5f), {0.6f, 0.59f, 0.58f}, kPale, kPale, {0.2f, 0.2f, 0.33f}, kPale};
    constexpr int kSegments = int(kColours.size()) - 3;
    const float height = p.y + variation * fractalNoise(p, roughness, octaves);
    const float place = kSegments * (0.5f + 0.5f * std::sin(height));
    const int first = std::min(int(place), kSegments - 1);
    // A cubic Bézier curve through four neighbours, by de Casteljau.
    const float t = place - float(first);
    std::array<glm::vec3, 4> c;
    std::copy_n(kColours.begin() + first, 4, c.begin());
    for (int level = 3; level > 0; --level)
        for (std::size_t i = 0; i < std::size_t(level); ++i) c[i] = glm::mix(c[i], c[i + 1], t);
    return 1.5f * c[0];
}

bool isInDot(glm::vec2 st) {
    constexpr float kRadius = 0.35f, kMaxShift = 0.5f - kRadius;
    const glm::vec2 cell = glm::floor(st + 0.5f);
    const auto at = [&](float s, float t) { return noise({cell.x + s, cell.y + t, 0.5f}); };
    if (!(at(0.5f, 0.5f) > 0)) return false;
    const glm::vec2 away = st - (cell + kMaxShift * glm::vec2(at(1.5f, 2.8f), at(4.5f, 9.8f)));
    return glm::dot(away, away) < kRadius * kRadius;
}

} // namespace slant
