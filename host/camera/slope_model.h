// How trajectories of scene points lean in the light field, by their depth.
#pragma once

namespace slant {

/// slope(w) = (c1 / w + c2 + c3 / w^2) / (1 + d1 / w + d2 / w^2), in pixels per lens radius. For a thin lens
/// of radius A focused at f, with S pixels per unit tangent: c1 = -S A, c2 = S A / f, the others 0; a real
/// lens has them where its entrance pupil is not at depth 0.
struct SlopeModel {
    float c1 = 0, c2 = 0, c3 = 0, d1 = 0, d2 = 0;
    float operator()(float w) const { return (c1 / w + c2 + c3 / w / w) / (1 + d1 / w + d2 / w / w); }
};

} // namespace slant
