// What a compound lens still does through the middle of its entrance pupil, from where points of the scene
// are seen at their pinhole positions: it distorts. Aberrations and the wandering of the pupil are left out.
//
// So a picture of pinhole positions, the layer map, can be laid out as the film is: with texels as wide as
// pixels, wherever a wide lens spreads or a fisheye crowds them.
#pragma once
#include "camera/lens_map.h"

namespace slant {

class LensDistortion {
public:
    /// Of a thin lens, which does not distort.
    LensDistortion() = default;
    /// For places up to `radiusPx` from the film's centre. Beyond the image it goes on evenly.
    LensDistortion(const LensMap& lens, float radiusPx);

    bool empty() const { return pinhole_.empty(); }
    vec2 centre() const { return vec2(texels_[0]); } ///< of the film
    /// From film to scene: the same lens with nothing but distortion, and light everywhere.
    const LensMap& pinhole() const { return pinhole_; }
    /// From scene to film: what shaders/lib/lens_distortion.glsl reads.
    const std::vector<vec4>& texels() const { return texels_; }
    /// Where the film has a pinhole position.
    vec2 onFilm(vec2 pinhole) const;

    /// The farthest that two places a pixel apart on the scene's side come to lie on the film.
    float steepest() const { return steepest_; }
    /// The farthest place on the entrance pupil from its middle, in radii.
    float pupilReach() const { return pupilReach_; }
    /// How far from there a ray through any other place on the pupil may meet the plane in focus, pixels of
    /// the film.
    float aberrationPx() const { return aberrationPx_; }

private:
    LensMap pinhole_;
    std::vector<vec4> texels_;
    float steepest_ = 1, pupilReach_ = 1, aberrationPx_ = 0;
};

} // namespace slant
