#include "camera/lens_map.h"

#include "camera/compound_lens.h"
#include "shared/kernel.h"

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
                if (ray) { // else beyond the image: like its neighbour
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

namespace {

struct LensMapKernels {
    const vec4* texels;

    const vec4& lensMapAt(int texel) const { return texels[texel]; }
#include "lib/lens_map.glsl"
};

} // namespace

SceneRay LensMap::at(vec2 raster, vec2 lens) const {
    return LensMapKernels{texels_.data()}.sceneRay(raster, lens);
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
        return "has invalid counts or steps";
    const double nodes = double(shape.y) * (double(shape.z) + 1) * (double(shape.w) + 1);
    if (double(texels.size()) != kLensMapHeader + double(head.w) + (ofStop ? 2 : 1) * nodes)
        return "does not have the length that its counts give";
    for (std::size_t i = 0; i < std::size_t(head.w); ++i) {
        const vec4& radius = texels[std::size_t(kLensMapHeader) + i];
        if (!(radius.y > 0 && radius.z > 0 && radius.w >= 0)) return "has a scale or irradiance below 0";
    }
    for (std::size_t i = texels.size() - (ofStop ? std::size_t(nodes) : 0); i < texels.size(); ++i)
        if (!(texels[i].x >= 0 && texels[i].z >= 0 && texels[i].z <= 1))
            return "has an irradiance below 0, or an invalid share";
    return nullptr;
}

} // namespace slant
