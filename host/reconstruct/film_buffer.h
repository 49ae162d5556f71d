// Stage "pixel_filter": dense samples through the pixel filter into the film, and the film into an image.
#pragma once
#include "image/image.h"
#include "lightfield/value_plane.h"
#include "reconstruct/filter_table.h"

#include <vector>

namespace slant {

/// Dense samples of a region of pixels, plane after plane: sample k of pixel (i, j) is
/// samples[k * region.area() + j * region.width() + i]. rgb, and in w the place in the pixel
/// (Output::positionCode), negative where there is no sample; kWholePixel where it stands for all of its
/// group, kLeftOut where others of its group stand for it.
struct DenseSamples {
    Rect region;
    std::vector<vec4> samples;
    int groupSize = 1; ///< planes of a lens group
};

/// The position code of a place in a pixel, both in [0, 1).
float positionCode(float fractionX, float fractionY);

/// Sums of weight * rgb and of weight, for each pixel of `frame`.
class FilmBuffer {
public:
    FilmBuffer(const Rect& frame, FilterTable filter);

    /// Adds dense planes to the rows y0 <= y < y1 of the frame, kFilmBlock planes at a time: the sum does not
    /// depend on how planes are split over calls as long as blocks stay whole. dense.region must hold the
    /// rows and the filter's reach around them.
    void accumulate(const DenseSamples& dense, int y0, int y1);

    const Rect& frame() const { return frame_; }
    const FilterTable& filter() const { return filter_; }
    const std::vector<vec4>& sums() const { return sums_; }

private:
    /// The contribution of the planes [begin, end) to a pixel.
    vec4 partOf(const DenseSamples& dense, int x, int y, int begin, int end) const;

    Rect frame_;
    FilterTable filter_;
    std::vector<vec4> sums_;
};

/// Sums of a frame, divided by their weights: R, G, B. Pixels without weight are black and counted.
Image filmImage(const Rect& frame, const std::vector<vec4>& sums, std::uint64_t& emptyPixels);

/// Input samples with their values as dense planes, as many planes as the pixel with most samples has
/// samples. Other pixels repeat theirs, so that all pixels have the same weight. Those that sanitize disabled
/// are left out; pixels of `region` outside `bounds` have none.
DenseSamples denseFromInput(const LightField& field, ValuePlane plane, const Rect& region);
/// The same with these values, one for each sample.
DenseSamples denseFromInput(const LightField& field, std::span<const vec3> values, const Rect& region);

} // namespace slant
