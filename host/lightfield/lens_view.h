// What a picture of a light field looks through: the traced lens or another one at its place, and the traced
// shutter or a part of it.
#pragma once
#include "lightfield/lightfield.h"

#include <optional>

namespace slant {

struct LensView {
    float slopeShift = 0;    ///< added to all slopes, pixels per lens radius: another focus (refocus.h)
    float apertureScale = 1; ///< radius of the aperture over that of the traced one; 0 = pinhole
    std::optional<Aperture> aperture = {}; ///< its shape; unset: the traced one
    /// When the shutter opens and closes, in the time of the samples, 0 <= open <= close <= 1; equal: one
    /// instant.
    float shutterOpen = 0, shutterClose = 1;

    const Aperture& apertureOf(const LightField& field) const {
        return aperture ? *aperture : field.aperture;
    }
    /// Whether it is the traced lens but for its focus.
    bool isTracedLens() const { return apertureScale == 1 && !aperture; }
    bool isTracedShutter() const { return shutterOpen == 0 && shutterClose == 1; }
};

} // namespace slant
