#include "trace/point_profile.h"

#include "image/octahedral.h"
#include "trace/warp.h"

namespace slant {
namespace {

/// pbrt shows nothing of a projection at a greater angle to its axis.
constexpr float kLeastCosine = 1e-3f;

/// World from a space whose z axis is the axis of the light.
glm::dmat3 axesOf(const Light& light) {
    const glm::dmat3 worldFromLight(light.worldFromLight);
    if (light.kind == LightKind::spot) {
        const Frame frame = Frame::around(glm::normalize(light.to - light.from));
        return worldFromLight * glm::dmat3(frame.x, frame.y, frame.z);
    }
    if (light.kind == LightKind::goniometric) // y is up in it, z in the image
        return worldFromLight * glm::dmat3({1, 0, 0}, {0, 0, 1}, {0, 1, 0});
    return worldFromLight * glm::dmat3({1, 0, 0}, {0, -1, 0}, {0, 0, 1}); // rows go down
}

} // namespace

PointProfile::PointProfile(const Scene& scene, const Light& light)
    : kind_(light.kind), emission_(light.emission) {
    const glm::dmat3 axes = axesOf(light);
    if (!(std::abs(glm::determinant(axes)) > 0))
        throw badInput(light.location, "the light's transform is singular");
    lightFromWorld_ = glm::mat3(glm::inverse(axes));
    if (kind_ == LightKind::spot) {
        cosOuter_ = std::cos(glm::radians(light.coneDegrees));
        cosInner_ = std::cos(glm::radians(light.coneDegrees - light.coneDeltaDegrees));
        powerOfOne_ = 2 * kPi * (1 - cosInner_ + (cosInner_ - cosOuter_) / 2);
        mean_ = emission_ * (powerOfOne_ / (4 * kPi));
        return;
    }
    image_ = &scene.images[std::size_t(light.imageIndex)];
    if (kind_ == LightKind::goniometric && image_->width() != image_->height())
        throw badInput(
            light.location,
            "the image of a goniometric light must be square (equal-area octahedral), but it is {}x{}",
            image_->width(), image_->height());
    const float aspect = float(image_->width()) / float(image_->height());
    screen_ = std::tan(glm::radians(light.fovDegrees) / 2) *
              (aspect > 1 ? glm::vec2(aspect, 1) : glm::vec2(1, 1 / aspect));
    sumImage();
}

void PointProfile::sumImage() {
    glm::dvec3 sum(0);
    for (int y = 0; y < image_->height(); ++y)
        for (int x = 0; x < image_->width(); ++x) {
            const glm::vec2 st = (glm::vec2(x, y) + 0.5f) / glm::vec2(image_->width(), image_->height());
            float solidAngle = 1; // over that on the axis
            if (kind_ == LightKind::projection) {
                const glm::vec2 place = screen_ * (2.f * st - 1.f);
                solidAngle = std::pow(1 + glm::dot(place, place), -1.5f);
            }
            sum += glm::dvec3(solidAngle * texel(st));
        }
    const glm::vec3 mean(sum / (double(image_->width()) * double(image_->height())));
    const float whole = kind_ == LightKind::projection ? 4 * screen_.x * screen_.y : 4 * kPi;
    powerOfOne_ = whole * luminance(mean);
    mean_ = emission_ * mean * (whole / (4 * kPi));
}

glm::vec3 PointProfile::texel(glm::vec2 st) const {
    const glm::ivec2 size(image_->width(), image_->height());
    const glm::ivec2 t = glm::clamp(glm::ivec2(glm::floor(st * glm::vec2(size))), glm::ivec2(0), size - 1);
    if (image_->channelCount() == 1) return glm::vec3(std::max(image_->at(t.x, t.y, 0), 0.f));
    return glm::max(glm::vec3(image_->at(t.x, t.y, 0), image_->at(t.x, t.y, 1), image_->at(t.x, t.y, 2)),
                    0.f);
}

glm::vec3 PointProfile::projected(glm::vec3 w) const {
    if (w.z < kLeastCosine) return glm::vec3(0);
    const glm::vec2 place = glm::vec2(w) / w.z / screen_;
    if (std::max(std::abs(place.x), std::abs(place.y)) > 1) return glm::vec3(0);
    return texel(0.5f * place + 0.5f);
}

glm::vec3 PointProfile::intensity(glm::vec3 direction) const {
    const glm::vec3 w = glm::normalize(lightFromWorld_ * direction);
    switch (kind_) {
    case LightKind::spot: {
        if (cosInner_ == cosOuter_) return w.z < cosOuter_ ? glm::vec3(0) : emission_;
        const float t = std::clamp((w.z - cosOuter_) / (cosInner_ - cosOuter_), 0.f, 1.f);
        return t * t * (3 - 2 * t) * emission_;
    }
    case LightKind::goniometric:
        return emission_ * texel(equalAreaSphereToSquare(w));
    case LightKind::projection:
        return emission_ * projected(w);
    default:
        return emission_;
    }
}

} // namespace slant
