#include "camera/lens_map.h"

#include "camera/compound_lens.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

constexpr int kRadii = 1024;
constexpr float kMaxNodes = float(1 << 24);

/// A ray of the lens on the scene's side: in doubles, and without the rest.
struct Traced {
    glm::dvec2 xy, uv; ///< xy from the film's centre
};

/// The ray to a place on the pupil from `px` to the right of the film's centre.
std::optional<Traced> traced(const CompoundLens& camera, double px, glm::dvec2 pupil) {
    const auto path = camera.path(camera.filmCentre() + glm::dvec2(px, 0), pupil / camera.pupil().radius(),
                                  camera.stopPupil() ? Rims::ignore : Rims::block);
    if (!path) return std::nullopt;
    return Traced{camera.sceneRay(path->line), camera.entrancePupilPlace(path->line)};
}

/// What the middle of the pupil sees, up to where it sees nothing.
std::vector<double> chiefPositions(const CompoundLens& camera, double stepPx) {
    std::vector<double> positions;
    for (int i = 0; i < kRadii; ++i) {
        const double px = i * stepPx;
        const auto ray = traced(camera, px, camera.pupil().at(px * camera.millimetresPerPixel(), {0, 0}));
        if (!ray || (i > 0 && !(ray->xy.x > positions.back()))) break;
        positions.push_back(ray->xy.x);
    }
    return positions;
}

/// Linear, as the map is looked up.
double interpolated(const std::vector<vec4>& radii, double place, int component) {
    const std::size_t k = std::min(std::size_t(place), radii.size() - 2);
    const double a = double(radii[k][component]), b = double(radii[k + 1][component]);
    return a + (place - double(k)) * (b - a);
}

} // namespace

LensMap makeLensMap(const CompoundLens& camera) {
    const ExitPupil& pupil = camera.pupil();
    const double radiusPx = pupil.filmRadius() / camera.millimetresPerPixel(),
                 stepPx = radiusPx / (kRadii - 1);
    const std::vector<double> chief = chiefPositions(camera, stepPx);
    std::vector<vec4> radii;
    for (std::size_t i = 0; i < chief.size(); ++i) {
        const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, chief.size() - 1);
        const double along = (chief[after] - chief[before]) / (double(after - before) * stepPx);
        const double across = i > 0 ? chief[i] / (double(i) * stepPx) : along;
        radii.emplace_back(chief[i], along, across,
                           pupil.irradiance(double(i) * stepPx * camera.millimetresPerPixel()));
    }
    const std::optional<StopPupil>& stop = camera.stopPupil();
    const double ringPx = radiusPx / (PupilNodes::kRings - 1);
    std::vector<vec4> texels{vec4(camera.filmCentre(), 1 / stepPx, radii.size()),
                             vec4(1 / ringPx, PupilNodes::kRings, PupilNodes::kTurns, PupilNodes::kDistances),
                             vec4(stop ? 1 : 0, 0, 0, 0)};
    texels.insert(texels.end(), radii.begin(), radii.end());
    std::vector<vec4> lights;
    vec4 last(0);
    for (int ring = 0; ring < PupilNodes::kRings; ++ring) {
        const double px = ring * ringPx, radius = px / stepPx;
        const bool lit = radius <= double(radii.size() - 1);
        for (int turn = 0; turn <= PupilNodes::kTurns; ++turn)
            for (int distance = 0; distance <= PupilNodes::kDistances; ++distance) {
                const glm::dvec2 place =
                    stop ? stop->node(ring, turn, distance).place : pupil.node(ring, turn, distance);
                const auto ray = lit ? traced(camera, px, place) : std::optional<Traced>();
                if (ray) { // else beyond the image; as what is next to it
                    const double aberration = ray->xy.x - interpolated(radii, radius, 0);
                    last = vec4(aberration / interpolated(radii, radius, 1),
                                ray->xy.y / interpolated(radii, radius, 2), ray->uv);
                }
                texels.push_back(last);
                if (!stop) continue;
                const StopPupil::Node& node = stop->node(ring, turn, distance);
                lights.emplace_back(node.irradiance, ray ? node.clearance : -1, stop->openShare(ring), 0);
            }
    }
    texels.insert(texels.end(), lights.begin(), lights.end());
    return LensMap(std::move(texels));
}

SceneRay LensMap::at(vec2 raster, vec2 lens) const {
    const vec4 &head = texels_[0], &shape = texels_[1];
    const vec2 offset = raster - vec2(head.x, head.y);
    const float r = glm::sqrt(offset.x * offset.x + offset.y * offset.y);
    const float radii = r * head.z;
    SceneRay place{};
    if (!(radii < head.w - 1)) return place;
    const int radius = int(radii);
    const vec4& inner = texels_[std::size_t(kLensMapHeader + radius)];
    const vec4 here =
        inner + (radii - float(radius)) * (texels_[std::size_t(kLensMapHeader + radius + 1)] - inner);
    if (!(here.w > 0)) return place;

    // In the frame of the radius.
    const vec2 e = r > 0 ? offset / r : vec2(1, 0);
    const vec2 d(lens.x * e.x + lens.y * e.y, lens.y * e.x - lens.x * e.y);
    const float rings = glm::min(r * shape.x, shape.y - 1);
    const int ring = glm::min(int(rings), int(shape.y) - 2);
    const float norm = glm::abs(d.x) + glm::abs(d.y);
    const float turns = norm > 0 ? (1 - d.x / norm) * (shape.z * 0.5f) : 0.f;
    const int turn = glm::min(int(turns), int(shape.z) - 1);
    const float distances = glm::min(glm::sqrt(d.x * d.x + d.y * d.y), 1.f) * shape.w;
    const int distance = glm::min(int(distances), int(shape.w) - 1);

    const int row = int(shape.w) + 1, plane = row * (int(shape.z) + 1);
    const int first = kLensMapHeader + int(head.w) + ring * plane + turn * row + distance;
    const auto along = [&](int index) {
        const vec4& a = texels_[std::size_t(index)];
        return a + (distances - float(distance)) * (texels_[std::size_t(index + 1)] - a);
    };
    const auto inRing = [&](int index) {
        const vec4 a = along(index);
        return a + (turns - float(turn)) * (along(index + row) - a);
    };
    const auto inPlace = [&](int index) {
        const vec4 a = inRing(index);
        return a + (rings - float(ring)) * (inRing(index + plane) - a);
    };
    const vec4 node = inPlace(first);
    place.weight = here.w;
    place.openShare = 1;
    if (texels_[2].x > 0) {
        const vec4 light = inPlace(first + plane * int(shape.y));
        place.weight = light.y >= 0 ? light.x : 0.f;
        place.openShare = light.z;
    }

    const float side = d.y < 0 ? -1.f : 1.f;
    const vec2 x(here.x + here.y * node.x, here.z * (side * node.y)), u(node.z, side * node.w);
    place.xy = vec2(head.x, head.y) + vec2(x.x * e.x - x.y * e.y, x.x * e.y + x.y * e.x);
    place.uv = vec2(u.x * e.x - u.y * e.y, u.x * e.y + u.y * e.x);
    const float along_ = 1 / here.y, across = 1 / here.z;
    place.filmMetric = vec3(across + e.x * e.x * (along_ - across), e.x * e.y * (along_ - across),
                            across + e.y * e.y * (along_ - across));
    const float skew = glm::abs(e.x * e.y * (here.y - here.z));
    place.extent =
        vec2(here.z + e.x * e.x * (here.y - here.z) + skew, here.z + e.y * e.y * (here.y - here.z) + skew);
    return place;
}

const char* faultOf(const std::vector<vec4>& texels) {
    for (const vec4& texel : texels)
        for (int i = 0; i < 4; ++i)
            if (!std::isfinite(texel[i])) return "holds a number that is not finite";
    if (texels.size() < std::size_t(kLensMapHeader)) return "is too short";
    const vec4 &head = texels[0], &shape = texels[1];
    const bool ofStop = texels[2].x > 0;
    const auto count = [](float value, float least) {
        return value >= least && value <= kMaxNodes && value == std::floor(value);
    };
    if (!(head.z > 0 && shape.x > 0 && count(head.w, 2) && count(shape.y, 2) && count(shape.z, 1) &&
          count(shape.w, 1)))
        return "has counts or steps that are no table's";
    const double nodes = double(shape.y) * (double(shape.z) + 1) * (double(shape.w) + 1);
    if (double(texels.size()) != kLensMapHeader + double(head.w) + (ofStop ? 2 : 1) * nodes)
        return "has another length than its counts say";
    for (std::size_t i = 0; i < std::size_t(head.w); ++i) {
        const vec4& radius = texels[std::size_t(kLensMapHeader) + i];
        if (!(radius.y > 0 && radius.z > 0 && radius.w >= 0)) return "has a scale or irradiance below 0";
    }
    for (std::size_t i = texels.size() - (ofStop ? std::size_t(nodes) : 0); i < texels.size(); ++i)
        if (!(texels[i].x >= 0 && texels[i].z >= 0 && texels[i].z <= 1))
            return "has an irradiance below 0, or a share that is none";
    return nullptr;
}

} // namespace slant
