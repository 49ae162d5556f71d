// Small scenes and a random number generator for tests of shading.
#pragma once
#include "scene/scene.h"
#include "trace/path.h"
#include "trace/warp.h"

#include <cstdint>
#include <functional>

namespace slant::test {

/// PCG32 (O'Neill 2014).
class Random {
public:
    explicit Random(std::uint64_t seed = 1) : state_(seed * 0x9e3779b97f4a7c15u + 1) {}
    float next1D() {
        std::uint64_t old = state_;
        state_ = old * 6364136223846793005u + 1442695040888963407u;
        std::uint32_t x = std::uint32_t(((old >> 18) ^ old) >> 27), r = std::uint32_t(old >> 59);
        return float(((x >> r) | (x << ((32 - r) & 31))) >> 8) * 0x1p-24f;
    }
    glm::vec2 next2D() {
        float x = next1D();
        return {x, next1D()};
    }

private:
    std::uint64_t state_;
};

/// A surface that lies askew, so that no axis is special.
inline const glm::vec3 kNormal = glm::normalize(glm::vec3(0.3f, -0.5f, 0.7f));
inline const glm::vec3 kTangent(1, 0.2f, 0);

inline glm::vec3 toWorld(glm::vec3 local) {
    return Frame::along(kNormal, kTangent).toWorld(local);
}

/// So many degrees from its normal, over 90 behind it.
inline glm::vec3 direction(float degrees, float azimuth) {
    const float t = glm::radians(degrees), p = glm::radians(azimuth);
    return toWorld({std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)});
}

inline int addConstant(Scene& scene, glm::vec3 value) {
    Texture t;
    t.value = value;
    scene.textures.push_back(t);
    return int(scene.textures.size()) - 1;
}

inline int addDiffuse(Scene& scene, glm::vec3 reflectance) {
    Material m;
    m.reflectance = addConstant(scene, reflectance);
    scene.materials.push_back(m);
    return int(scene.materials.size()) - 1;
}

/// A mesh of one shape that emits `light`.
inline void addEmittingMesh(Scene& scene, Mesh mesh, AreaLight light) {
    scene.meshes.push_back(std::move(mesh));
    scene.areaLights.push_back(light);
    Shape shape;
    shape.meshIndex = int(scene.meshes.size()) - 1;
    shape.areaLightIndex = int(scene.areaLights.size()) - 1;
    shape.materialIndex = 0;
    scene.shapes.push_back(shape);
}

inline void addEmittingShape(Scene& scene, Shape shape, AreaLight light) {
    scene.areaLights.push_back(light);
    shape.areaLightIndex = int(scene.areaLights.size()) - 1;
    shape.materialIndex = 0;
    scene.shapes.push_back(shape);
}

/// Mean of `estimate` over many samples and the standard error of that mean.
struct Estimate {
    double mean = 0, error = 0;
};
inline Estimate average(int count, const std::function<double()>& estimate) {
    double sum = 0, sum2 = 0;
    for (int i = 0; i < count; ++i) {
        double x = estimate();
        sum += x;
        sum2 += x * x;
    }
    double mean = sum / count;
    return {mean, std::sqrt(std::max(0.0, sum2 / count - mean * mean) / count)};
}

} // namespace slant::test
