// Small scenes built by hand, for tests of the tracer.
#pragma once
#include "scene/scene.h"
#include "trace/interaction.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <random>

namespace slant::testing {

inline MovingTransform still(const glm::dmat4& m) {
    return {{m, m}};
}

/// A grey diffuse material and a light, a camera at the origin looking along +z.
inline Scene emptyScene(int width = 64, int height = 48) {
    Scene scene;
    scene.film.xResolution = width;
    scene.film.yResolution = height;
    scene.film.crop = {0, 0, width, height};
    float aspect = float(width) / float(height);
    scene.camera.screenMin = {-std::max(aspect, 1.f), -std::max(1 / aspect, 1.f)};
    scene.camera.screenMax = -scene.camera.screenMin;
    scene.camera.fovDegrees = 60;
    Texture grey;
    grey.value = glm::vec3(0.5f);
    scene.textures.push_back(grey);
    Material diffuse;
    diffuse.reflectance = 0;
    scene.materials.push_back(diffuse);
    Light light;
    light.kind = LightKind::infinite;
    scene.lights.push_back(light);
    return scene;
}

inline Shape sphereShape(float radius, const glm::dmat4& worldFromObject) {
    Shape shape;
    shape.kind = ShapeKind::sphere;
    shape.radius = radius;
    shape.zMin = -radius;
    shape.zMax = radius;
    shape.materialIndex = 0;
    shape.worldFromObject = still(worldFromObject);
    return shape;
}

inline Shape meshShape(Scene& scene, Mesh mesh, const glm::dmat4& worldFromObject = glm::dmat4(1)) {
    Shape shape;
    shape.meshIndex = int(scene.meshes.size());
    shape.materialIndex = 0;
    shape.worldFromObject = still(worldFromObject);
    scene.meshes.push_back(std::move(mesh));
    return shape;
}

/// A unit sphere of triangles or bilinear patches, `rings` x 2 rings.
inline Mesh ballMesh(int rings, Mesh::Kind kind) {
    Mesh mesh;
    mesh.kind = kind;
    const int columns = 2 * rings;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < columns; ++j) {
            double theta = std::numbers::pi * i / rings, phi = 2 * std::numbers::pi * j / columns;
            mesh.positions.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                        std::cos(theta));
        }
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < columns; ++j) {
            auto index = [&](int row, int column) { return std::uint32_t(row * columns + column % columns); };
            std::uint32_t a = index(i, j), b = index(i, j + 1), c = index(i + 1, j), d = index(i + 1, j + 1);
            if (kind == Mesh::Kind::bilinearPatches)
                mesh.indices.insert(mesh.indices.end(), {a, b, c, d});
            else
                mesh.indices.insert(mesh.indices.end(), {a, b, c, b, d, c});
        }
    return mesh;
}

struct RandomRays {
    std::mt19937 random;
    std::normal_distribution<float> normal;

    explicit RandomRays(unsigned seed) : random(seed) {}
    glm::vec3 direction() {
        return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    }
    /// From a sphere of that radius towards a point within the unit ball or so.
    Ray inwards(float radius) {
        glm::vec3 origin = radius * direction();
        return {origin, glm::normalize(0.8f * direction() - origin)};
    }
};

} // namespace slant::testing
