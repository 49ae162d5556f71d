#include "trace/environment.h"

namespace slant {
namespace {

constexpr float kMaxImageChance = 0.9f;

float level(glm::vec3 rgb) {
    return (rgb.x + rgb.y + rgb.z) / 3;
}

/// First index whose cumulative value exceeds u, and where u lies inside its step, in [0, 1).
int invertCdf(const float* cdf, int count, float u, float& inside) {
    int i = int(std::upper_bound(cdf, cdf + count, u) - cdf);
    i = std::min(i, count - 1);
    while (i > 0 && cdf[i] == cdf[i - 1]) --i; // never a step of zero height
    float before = i > 0 ? cdf[i - 1] : 0.f, height = cdf[i] - before;
    inside = height > 0 ? std::clamp((u - before) / height, 0.f, 0x1.fffffep-1f) : 0.5f;
    return i;
}

/// Turns weights into their cumulative sums over the total; returns the total.
double makeCdf(const std::vector<double>& weights, float* cdf) {
    double total = 0, sum = 0;
    for (double w : weights) total += w;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += weights[i];
        cdf[i] = total > 0 ? float(sum / total) : float(i + 1) / float(weights.size());
    }
    return total;
}

} // namespace

Environment::Environment(glm::vec3 radiance) : constant_(radiance), mean_(radiance) {}

Environment::Environment(const Image& image, float scale, const glm::dmat4& worldFromLight)
    : image_(&image), size_(image.width()), scale_(scale), worldFromLight_(worldFromLight),
      lightFromWorld_(glm::inverse(glm::dmat3(worldFromLight))) {
    glm::dvec3 sum(0);
    for (int y = 0; y < size_; ++y)
        for (int x = 0; x < size_; ++x) sum += glm::dvec3(texel(x, y));
    double texels = double(size_) * double(size_);
    mean_ = glm::vec3(sum / texels);
    meanLevel_ = level(mean_);

    rowCdf_.resize(std::size_t(size_));
    columnCdf_.resize(std::size_t(size_) * std::size_t(size_));
    std::vector<double> rows(static_cast<std::size_t>(size_)), columns(static_cast<std::size_t>(size_));
    for (int y = 0; y < size_; ++y) {
        for (int x = 0; x < size_; ++x) columns[std::size_t(x)] = double(excess(x, y));
        rows[std::size_t(y)] = makeCdf(columns, &columnCdf_[std::size_t(y) * std::size_t(size_)]);
    }
    double total = makeCdf(rows, rowCdf_.data());
    excessSum_ = float(total);
    if (meanLevel_ > 0)
        imageChance_ = std::min(float(total / (double(meanLevel_) * texels)), kMaxImageChance);
}

glm::ivec2 Environment::texelOf(glm::vec2 st) const {
    return glm::clamp(glm::ivec2(st * float(size_)), glm::ivec2(0), glm::ivec2(size_ - 1));
}

glm::vec3 Environment::texel(int x, int y) const {
    return scale_ * glm::max(glm::vec3(image_->at(x, y, 0), image_->at(x, y, 1), image_->at(x, y, 2)), 0.f);
}

float Environment::excess(int x, int y) const {
    return std::max(0.f, level(texel(x, y)) - meanLevel_);
}

glm::vec3 Environment::radiance(glm::vec3 direction) const {
    if (!image_) return constant_;
    glm::ivec2 t = texelOf(equalAreaSphereToSquare(glm::normalize(lightFromWorld_ * direction)));
    return texel(t.x, t.y);
}

glm::vec3 Environment::sample(glm::vec3 normal, float chance, glm::vec2 u) const {
    if (chance >= imageChance_)
        return glm::normalize(Frame::around(normal).toWorld(warpToCosineHemisphere(u)));
    glm::vec2 inside;
    int y = invertCdf(rowCdf_.data(), size_, u.y, inside.y);
    int x = invertCdf(&columnCdf_[std::size_t(y) * std::size_t(size_)], size_, u.x, inside.x);
    glm::vec2 st = (glm::vec2(x, y) + inside) / float(size_);
    return glm::normalize(worldFromLight_ * equalAreaSquareToSphere(st));
}

float Environment::pdf(glm::vec3 normal, glm::vec3 direction) const {
    float cosine = (1 - imageChance_) * kInvPi * std::max(0.f, glm::dot(normal, direction));
    if (imageChance_ == 0) return cosine;
    glm::ivec2 t = texelOf(equalAreaSphereToSquare(glm::normalize(lightFromWorld_ * direction)));
    float texels = float(size_) * float(size_);
    return cosine + imageChance_ * excess(t.x, t.y) / excessSum_ * texels / (4 * kPi);
}

} // namespace slant
