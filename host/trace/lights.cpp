#include "trace/lights.h"

#include "base/error.h"
#include "image/octahedral.h"

namespace slant {
namespace {

/// Moving emitters are bounded by what they are at so many times, and this much of a step and of their size.
constexpr int kMotionSteps = 16;
constexpr float kStepMargin = 0.5f, kSizeMargin = 0.02f;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Mean luminance times cosine over the upper half (z > 0) of the map times 2 pi: what pbrt-v4 scales to the
/// wanted illuminance. (The solid angle of that half would give 4 pi; the same picture matters more.)
float mapIlluminance(const Image& image) {
    double sum = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            glm::vec2 st((float(x) + 0.5f) / float(image.width()), (float(y) + 0.5f) / float(image.height()));
            float cosine = equalAreaSquareToSphere(st).z;
            if (cosine <= 0) continue;
            sum += double(cosine * luminance({image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)}));
        }
    return float(2 * double(kPi) * sum / (double(image.width()) * double(image.height())));
}

/// The box, cone and strength of an emitter.
LightBounds boundsAtOnce(const Emitter& e, std::span<const EmitterQuadric> quadrics) {
    LightBounds b;
    b.low = b.high = e.origin;
    b.twoSided = e.twoSided;
    b.intensity = luminance(e.radiance) * e.area;
    b.cosineSpread = -1;
    auto cover = [&](glm::vec3 p) {
        b.low = glm::min(b.low, p);
        b.high = glm::max(b.high, p);
    };
    switch (e.shape) {
    case Emitter::Shape::point:
        b.intensity = luminance(e.profile ? e.radiance * e.profile->mean() : e.radiance);
        break;
    case Emitter::Shape::patch:
        cover(e.origin + e.edge1 + e.edge2 + e.twist);
        [[fallthrough]];
    case Emitter::Shape::triangle:
        cover(e.origin + e.edge1);
        cover(e.origin + e.edge2);
        if (e.shape == Emitter::Shape::triangle) {
            b.axis = e.normal;
            b.cosineSpread = 1;
        }
        break;
    case Emitter::Shape::sphere:
        b.low -= e.radius;
        b.high += e.radius;
        break;
    case Emitter::Shape::quadric: {
        const EmitterQuadric& q = quadrics[std::size_t(e.quadric)];
        const float low = q.profile ? float(q.profile->lowZ()) : q.height,
                    high = q.profile ? float(q.profile->highZ()) : q.height,
                    r = q.profile ? float(q.profile->radius) : q.radius;
        b.low = glm::vec3(kInfinity);
        b.high = glm::vec3(-kInfinity);
        for (int corner = 0; corner < 8; ++corner)
            cover(glm::vec3(q.worldFromObject *
                            glm::vec4(corner & 1 ? r : -r, corner & 2 ? r : -r, corner & 4 ? high : low, 1)));
        break;
    }
    }
    return b;
}

/// Bilinear; beyond its edges the image goes on as it is there. Its first row lies at the top.
glm::vec3 lookUp(const Image& image, glm::vec2 uv) {
    const glm::vec2 p = glm::vec2(uv.x, 1 - uv.y) * glm::vec2(image.width(), image.height()) - 0.5f;
    const glm::vec2 corner = glm::floor(p), f = p - corner;
    const auto texel = [&](int dx, int dy) {
        const int x = std::clamp(int(corner.x) + dx, 0, image.width() - 1),
                  y = std::clamp(int(corner.y) + dy, 0, image.height() - 1);
        return glm::max(glm::vec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)), 0.f);
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), f.x), glm::mix(texel(0, 1), texel(1, 1), f.x), f.y);
}

/// Two triangles side by side in one plane that shine to the same side: one light to choose.
bool formQuadrilateral(const Emitter& a, const Emitter& b) {
    if (a.shape != Emitter::Shape::triangle || b.shape != Emitter::Shape::triangle ||
        a.twoSided != b.twoSided || a.motion != b.motion || glm::dot(a.normal, b.normal) < 0.9999f)
        return false;
    int shared = 0;
    for (glm::vec3 p : {a.origin, a.origin + a.edge1, a.origin + a.edge2})
        for (glm::vec3 q : {b.origin, b.origin + b.edge1, b.origin + b.edge2})
            shared += glm::dot(p - q, p - q) <= 1e-10f * a.size2;
    return shared == 2;
}

} // namespace

Lights::Lights(const Scene& scene) {
    EmittingShapes made = makeEmitters(scene);
    emitters_ = std::move(made.emitters);
    quadrics_ = std::move(made.quadrics);
    motions_ = std::move(made.motions);
    shapes_ = std::move(made.shapes);
    for (const Light& light : scene.lights) addLight(scene, light);
    addTree();
}

void Lights::addLight(const Scene& scene, const Light& light) {
    switch (light.kind) {
    case LightKind::point:
    case LightKind::spot:
    case LightKind::goniometric:
    case LightKind::projection:
        addPointLight(scene, light);
        break;
    case LightKind::distant: {
        glm::dvec3 back = glm::dmat3(light.worldFromLight) * (glm::dvec3(light.from) - glm::dvec3(light.to));
        if (!(glm::length(back) > 0))
            throw badInput(light.location, "distant light: \"from\" and \"to\" are the same");
        distant_.push_back({glm::vec3(glm::normalize(back)),
                            light.emission * light.scale * light.illuminance.value_or(1.f)});
        break;
    }
    case LightKind::infinite:
        addInfiniteLight(scene, light);
        break;
    }
}

void Lights::addPointLight(const Scene& scene, const Light& light) {
    Emitter e;
    e.origin = transformPoint(light.worldFromLight, light.from);
    if (light.kind == LightKind::point) {
        e.radiance = light.emission * light.scale * (light.power ? *light.power / (4 * kPi) : 1.f);
    } else {
        e.profile = &profiles_.emplace_back(scene, light);
        const float whole = e.profile->powerOfOne();
        e.radiance = glm::vec3(light.scale * (light.power && whole > 0 ? *light.power / whole : 1.f));
    }
    emitters_.push_back(e);
}

void Lights::addInfiniteLight(const Scene& scene, const Light& light) {
    portals_.emplace_back();
    if (light.portal) {
        portals_.back().emplace(*light.portal, light.location);
        complete_ = false;
    }
    if (light.imageIndex < 0) {
        infinite_.emplace_back(light.emission * light.scale *
                               (light.illuminance ? *light.illuminance / kPi : 1.f));
        return;
    }
    const Image& image = scene.images[std::size_t(light.imageIndex)];
    if (image.width() != image.height() || image.width() < 1 || image.channelCount() != 3)
        throw badInput(light.location,
                       "infinite light: its image must be square (equal-area octahedral) with "
                       "channels R, G, B; it is {} x {} with {} channels",
                       image.width(), image.height(), image.channelCount());
    float scale = light.scale;
    if (light.illuminance) {
        float given = mapIlluminance(image);
        if (!(given > 0))
            throw badInput(light.location,
                           "infinite light: \"illuminance\" needs an image that is not black above");
        scale *= *light.illuminance / given;
    }
    infinite_.emplace_back(image, scale, light.worldFromLight);
}

template <typename Use>
auto Lights::withEmitter(int piece, float time, Use&& use) const {
    const Emitter& e = emitters_[std::size_t(piece)];
    if (e.motion < 0) return use(e, std::span<const EmitterQuadric>(quadrics_));
    const glm::dmat4 by = motions_[std::size_t(e.motion)].since0(double(time));
    Emitter now = moved(e, by);
    if (e.quadric < 0) return use(now, std::span<const EmitterQuadric>());
    const EmitterQuadric quadric = moved(quadrics_[std::size_t(e.quadric)], by);
    now.quadric = 0;
    return use(now, std::span(&quadric, 1));
}

LightBounds Lights::boundsOf(const Emitter& emitter) const {
    if (emitter.motion < 0) return boundsAtOnce(emitter, quadrics_);
    LightBounds all;
    glm::vec3 low, step(0);
    for (int i = 0; i <= kMotionSteps; ++i) {
        const LightBounds now =
            withEmitter(int(&emitter - emitters_.data()), float(i) / kMotionSteps,
                        [](const Emitter& e, auto quadrics) { return boundsAtOnce(e, quadrics); });
        if (i > 0) step = glm::max(step, glm::abs(now.low - low));
        low = now.low;
        all = i > 0 ? LightBounds::join(all, now) : now;
    }
    const glm::vec3 margin = kStepMargin * step + kSizeMargin * (all.high - all.low);
    all.low -= margin;
    all.high += margin;
    all.intensity /= kMotionSteps + 1;
    if (all.cosineSpread < 0.9999f)
        all.cosineSpread = -1; // it turns: between these times beyond their normals
    return all;
}

void Lights::addTree() {
    std::vector<LightBounds> bounds;
    leafOf_.assign(emitters_.size(), -1);
    for (std::size_t i = 0; i < emitters_.size(); ++i) {
        const Emitter& e = emitters_[i];
        if (!(luminance(e.radiance) > 0)) continue;
        if (!e.sampled && e.area > 0) complete_ = false;
        if (!e.sampled) continue;
        if (!e.bounded()) complete_ = false;
        LightBounds own = boundsOf(e);
        if (i > 0 && leafOf_[i - 1] >= 0 && leaves_.back().second < 0 &&
            formQuadrilateral(emitters_[i - 1], e)) {
            leaves_.back().second = int(i);
            leaves_.back().firstChance = bounds.back().intensity / (bounds.back().intensity + own.intensity);
            bounds.back() = LightBounds::join(bounds.back(), own);
        } else {
            leaves_.push_back({int(i), -1, 1});
            bounds.push_back(own);
        }
        leafOf_[i] = int(leaves_.size()) - 1;
    }
    tree_ = LightTree(bounds);
    needsChoice_ = optionCount() > 1 || leaves_.size() > 1 || !infinite_.empty() ||
                   (!leaves_.empty() && leaves_[0].second >= 0);
}

int Lights::pieceOf(const SurfaceHit& hit) const {
    const EmittingShape& shape = shapes_[std::size_t(hit.emitter.light)];
    if (!shape.patches) return shape.first + hit.emitter.primitive;
    int piece = shape.first + 2 * hit.emitter.primitive;
    if (emitters_[std::size_t(piece)].shape == Emitter::Shape::patch) return piece;
    return withEmitter(piece, hit.time, [&](const Emitter& e, auto) {
        // Beyond the edge p10-p01 lies the other half.
        glm::vec3 inwards = glm::cross(glm::cross(e.edge1, e.edge2), e.edge2 - e.edge1);
        return glm::dot(inwards, hit.position - (e.origin + e.edge1)) >= 0 ? piece : piece + 1;
    });
}

glm::vec3 Lights::emitted(const SurfaceHit& hit, glm::vec3 wo) const {
    if (hit.emitter.light < 0) return glm::vec3(0);
    const Emitter& e = emitters_[std::size_t(pieceOf(hit))];
    if (!e.twoSided && glm::dot(hit.geometricNormal, wo) < 0) return glm::vec3(0);
    const Image* image = shapes_[std::size_t(hit.emitter.light)].image;
    return image ? e.radiance * lookUp(*image, hit.uv) : e.radiance;
}

bool Lights::complete(const SurfaceHit& hit) const {
    int piece = pieceOf(hit);
    return leafOf_[std::size_t(piece)] >= 0 && emitters_[std::size_t(piece)].bounded();
}

float Lights::importance(std::size_t option, const Receiver& receiver) const {
    if (option < infinite_.size()) return kPi * luminance(infinite_[option].meanRadiance());
    option -= infinite_.size();
    if (option < distant_.size())
        return luminance(distant_[option].radiance) *
               std::max(0.f, glm::dot(receiver.normal, distant_[option].direction));
    return tree_.importance(receiver);
}

float Lights::optionChance(std::size_t option, const Receiver& receiver) const {
    if (optionCount() == 1) return 1;
    float total = 0;
    for (std::size_t i = 0; i < optionCount(); ++i) total += importance(i, receiver);
    return total > 0 ? importance(option, receiver) / total : 0;
}

int Lights::chooseOption(const Receiver& receiver, float& choice, float& chance) const {
    int count = int(optionCount());
    chance = 1;
    if (count == 1) return 0;
    float total = 0;
    for (int i = 0; i < count; ++i) total += importance(std::size_t(i), receiver);
    float rest = choice * total;
    int chosen = -1;
    for (int i = 0; i < count; ++i) {
        float part = importance(std::size_t(i), receiver);
        if (!(part > 0)) continue;
        chosen = i; // stays the last one where rounding carries `rest` beyond the end
        chance = part / total;
        choice = std::min(rest / part, 0x1.fffffep-1f);
        if (rest < part) break;
        rest -= part;
    }
    return chosen;
}

bool Lights::sample(const Receiver& receiver, float choice, glm::vec2 u, LightSample& sample) const {
    float chance;
    int chosen = chooseOption(receiver, choice, chance);
    if (chosen < 0) return false;
    std::size_t option = std::size_t(chosen);
    if (option < infinite_.size()) {
        const Environment& environment = infinite_[option];
        const auto& portal = portals_[option];
        glm::vec3 direction =
            portal ? portal->sample(receiver.position, u) : environment.sample(receiver.normal, choice, u);
        float pdf = chance * (portal ? portal->pdf(receiver.position, direction)
                                     : environment.pdf(receiver.normal, direction));
        sample = {direction, kInfinity, environment.radiance(direction), pdf, false, !portal};
        return pdf > 0;
    }
    if (option < infinite_.size() + distant_.size()) {
        const Distant& distant = distant_[option - infinite_.size()];
        sample = {distant.direction, kInfinity, distant.radiance, chance, true, true};
        return true;
    }
    float treeChance;
    int index = tree_.sample(receiver, choice, treeChance);
    if (index < 0) return false;
    const Leaf& leaf = leaves_[std::size_t(index)];
    bool first = choice < leaf.firstChance;
    const bool found =
        withEmitter(first ? leaf.first : leaf.second, receiver.time, [&](const Emitter& e, auto quadrics) {
            return sampleEmitter(e, quadrics, receiver, u, sample);
        });
    if (!found) return false;
    if (emitters_[std::size_t(first ? leaf.first : leaf.second)].invisible) sample.delta = true;
    sample.pdf *= chance * treeChance * (first ? leaf.firstChance : 1 - leaf.firstChance);
    return true;
}

float Lights::pdf(const Receiver& receiver, const SurfaceHit& hit, glm::vec3 direction) const {
    int piece = pieceOf(hit), index = leafOf_[std::size_t(piece)];
    if (index < 0) return 0;
    const Leaf& leaf = leaves_[std::size_t(index)];
    float half = piece == leaf.first ? leaf.firstChance : 1 - leaf.firstChance;
    return optionChance(optionCount() - 1, receiver) * tree_.chance(receiver, index) * half *
           withEmitter(piece, receiver.time, [&](const Emitter& e, auto quadrics) {
               return emitterPdf(e, quadrics, receiver, direction, hit.position, hit.geometricNormal);
           });
}

float Lights::infinitePdf(const Receiver& receiver, std::size_t i, glm::vec3 direction) const {
    return optionChance(i, receiver) * (portals_[i] ? portals_[i]->pdf(receiver.position, direction)
                                                    : infinite_[i].pdf(receiver.normal, direction));
}

} // namespace slant
