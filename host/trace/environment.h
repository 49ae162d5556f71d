// Light from an infinitely distant sphere: the same from everywhere, or an equal-area octahedral image.
//
// A receiver samples it by one mixture: with chance `imageChance_` a texel in proportion to how much it
// exceeds the mean of the image, else a direction in proportion to the cosine to its normal. The estimate of
// the irradiance stays bounded, for flat skies and for suns, without a second strategy.
#pragma once
#include "image/octahedral.h"
#include "scene/scene.h"
#include "trace/warp.h"

namespace slant {

/// Keeps a pointer to the image, which must live longer.
class Environment {
public:
    /// Of constant radiance.
    explicit Environment(glm::vec3 radiance);
    /// Radiance is `scale` times the image, whose three channels lie in the square; negative texels count as
    /// 0.
    Environment(const Image& image, float scale, const glm::dmat4& worldFromLight);

    /// Arriving along `direction` (unit, world space, towards the light).
    glm::vec3 radiance(glm::vec3 direction) const;
    /// Mean over the sphere.
    glm::vec3 meanRadiance() const { return mean_; }
    /// `normal`: the receiver's, unit. Returns the direction; `chance` and u uniform in [0, 1).
    glm::vec3 sample(glm::vec3 normal, float chance, glm::vec2 u) const;
    /// Density of sample() over solid angle.
    float pdf(glm::vec3 normal, glm::vec3 direction) const;

private:
    glm::ivec2 texelOf(glm::vec2 st) const;
    glm::vec3 texel(int x, int y) const;
    float excess(int x, int y) const;

    const Image* image_ = nullptr;
    int size_ = 0;
    float scale_ = 1;
    glm::vec3 constant_{0}, mean_{0};
    glm::mat3 worldFromLight_{1}, lightFromWorld_{1};
    float imageChance_ = 0;
    float meanLevel_ = 0;
    float excessSum_ = 0;          ///< of all texels
    std::vector<float> rowCdf_;    ///< size_ entries: excess of rows 0..y, over the sum
    std::vector<float> columnCdf_; ///< size_ entries per row, over the row's sum
};

} // namespace slant
