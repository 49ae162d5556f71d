// The opening of a lens, for choosing lens positions: a map from the unit square onto it whose density is
// proportional to the light that passes, so that every position has the same weight.
//
// For the disc it is Shirley and Chiu's concentric map. For an outline, the triangles of the outline replace
// the sectors of the disc: linear within each, the map preserves areas. For weights, the angles and then the
// distances in the disc go through the inverse of their cumulative distribution (shaders/lib/aperture.glsl).
#pragma once
#include "scene/aperture_shape.h"

#include <memory>
#include <span>

namespace slant {

/// Lens positions that some part of the square is mapped to.
struct LensBox {
    glm::vec2 min, max;
};

/// Immutable; copies share what they hold.
class Aperture {
public:
    Aperture() : Aperture(ApertureShape()) {} ///< the disc
    explicit Aperture(ApertureShape shape);

    const ApertureShape& shape() const { return data_->shape; }
    bool isDisc() const { return data_->table[0] == 0; }

    /// `square` in [-1, 1)^2 -> the unit disc.
    glm::vec2 at(glm::vec2 square) const;
    /// The share of the light that passes there, 0 to 1; 0 outside.
    float transmission(glm::vec2 lens) const;
    /// Its mean over the disc.
    double meanTransmission() const;
    /// Encloses what at() makes of a rectangle of [-1, 1]^2; the disc's must not be much longer than wide.
    LensBox box(glm::vec2 squareMin, glm::vec2 squareMax) const;

    /// What at() reads, for lib/aperture.glsl. First 0 for the disc. Or the number of corners, then their
    /// positions, the first one again last. Or -1, then the cumulative light of sectors from 0 to 1, then of
    /// the rings of each sector.
    std::span<const float> table() const { return data_->table; }

private:
    struct Data {
        ApertureShape shape;
        std::vector<float> table;
    };

    LensBox outlineBox(glm::vec2 squareMin, glm::vec2 squareMax) const;
    LensBox weightsBox(glm::vec2 squareMin, glm::vec2 squareMax) const;
    glm::vec2 corner(int i) const { return {data_->table[1 + 2 * i], data_->table[2 + 2 * i]}; }

    std::shared_ptr<const Data> data_;
};

/// The share of an aperture's light that would pass outside another one, its lens being `scale` times as
/// wide.
double shareOutside(const Aperture& aperture, float scale, const Aperture& other);

} // namespace slant
