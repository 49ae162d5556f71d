// How trajectories of scene points lean in the light field, by their depth.
#pragma once

namespace slant {

/// slope(w) = c1 / w + c2, in pixels per lens radius. For a lens of radius A focused at f, with S pixels per
/// unit tangent: c1 = -S A, c2 = S A / f. Exact for thin lenses, and for real ones on the scene's side.
struct SlopeModel {
    float c1 = 0, c2 = 0;
    float operator()(float w) const { return c1 / w + c2; }
};

} // namespace slant
