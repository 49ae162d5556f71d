#include "lightfield/scene_side.h"

#include "base/parallel.h"

#include <cmath>
#include <limits>

namespace slant {

SceneSideSamples::SceneSideSamples(const LightField& field, bool moved) : field_(field) {
    if (!moved || field.lensMap.empty()) return;
    moved_ = field.samples;
    irradiance_.resize(moved_.size());
    areaExcess_.resize(moved_.size());
    parallelFor(0, moved_.size(), 1 << 14, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            LightFieldSample& s = moved_[i];
            const bool disabled = std::isnan(s.slope); // its place may lie anywhere
            const SceneRay ray = disabled ? SceneRay{} : field.lensMap.at({s.x, s.y}, {s.u, s.v});
            const vec3& m = ray.filmMetric;
            s.x = ray.xy.x;
            s.y = ray.xy.y;
            s.u = ray.uv.x;
            s.v = ray.uv.y;
            irradiance_[i] = ray.weight;
            areaExcess_[i] = 1 / ((m.x * m.z - m.y * m.y) * ray.openShare) - 1;
            const float sum = s.x + s.y + s.u + s.v + 1 / ray.weight + areaExcess_[i];
            if (ray.weight > 0 && std::isfinite(sum)) continue;
            s = {};
            s.slope = std::numeric_limits<float>::quiet_NaN();
            irradiance_[i] = std::numeric_limits<float>::infinity();
            areaExcess_[i] = 0;
        }
    });
}

glm::vec3 SceneSideSamples::value(ValuePlane plane, std::size_t sample) const {
    const glm::vec3 value = valueOf(field_, plane, sample);
    if (irradiance_.empty()) return value;
    const auto finite = [](float x) { return std::isfinite(x) ? x : 0.f; };
    const float irradiance = irradiance_[sample];
    return {finite(value.x / irradiance), finite(value.y / irradiance), finite(value.z / irradiance)};
}

} // namespace slant
