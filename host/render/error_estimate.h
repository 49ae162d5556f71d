// How far a picture is from the truth, estimated from the samples it is made of alone.
//
// Two halves of the samples are reconstructed as the whole is. What they show differs by their noise, and by
// what the method makes of too few samples; the whole, with twice the samples of either, is off by half their
// difference. An error that both halves share, as the softening of what is finer than samples, stays unseen.
#pragma once
#include "render/field_pictures.h"

#include <array>
#include <cstdint>

namespace slant {

class ErrorEstimate {
public:
    /// Reconstructs the halves, with a few outputs for each pixel; stage "error estimate" of `report`. Adds
    /// to `agreements` if they are compared with the CPU's. Throws what FieldPictures throws.
    ErrorEstimate(Backend& backend, const LightField& field, const ReconstructOptions& options,
                  const LensView& view, bool compareWithCpu, Monitor& monitor, ReconstructReport& report,
                  std::vector<Agreement>& agreements);

    /// Of the whole picture, as image/metrics.h has it.
    double relMse() const;
    /// Adds channels error.R, .G, .B: the root mean square error of each value, the mean around a pixel
    /// (about 5 pixels wide), in the unit of the picture.
    void addChannels(Image& image) const;
    /// How many of `extra` samples go to each pixel of the frame, row by row. Samples of a pixel are to be in
    /// proportion to the relative error that one sample there has; `before`: how many there are.
    std::vector<std::uint32_t> place(std::span<const std::uint32_t> before, std::uint64_t extra) const;

private:
    std::array<Image, 2> halves_;
};

} // namespace slant
