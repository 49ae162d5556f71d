// How far an image is from its reference, in numbers.
#pragma once
#include "image/image.h"

#include <cstdint>
#include <vector>

namespace slant {

/// Keeps relMSE from dividing by what is black.
inline constexpr double kRelMseFloor = 0.01;

/// One value of an image: pixel in film coordinates, index into Image::channels.
struct ValuePlace {
    int x = 0, y = 0, channel = 0;
};

/// Over all values (pixels times channels), in double precision. If any value of either image is NaN or
/// infinite, nonFinite counts them and every figure but those of nonFinite is NaN, so that no bound holds.
struct Metrics {
    double mse = 0;    ///< mean of err^2
    double relMse = 0; ///< mean of err^2 / (reference^2 + kRelMseFloor)
    double psnr = 0;   ///< dB for a peak of 1: -10 log10(mse); +infinity for equal images
    double mae = 0;    ///< mean of |err|
    double p99 = 0;    ///< 99th percentile of |err|: the smallest value that 99 % of them do not exceed
    double maxAbs = 0; ///< largest |err|, and the first place where it stands
    ValuePlace maxPlace;
    float maxValue = 0, maxReference = 0;

    /// Mean of the image over mean of the reference, less 1; infinite if only the reference is black.
    double drift = 0;
    std::vector<double> channelDrift; ///< for each channel

    std::uint64_t nonFinite = 0; ///< places where either image is NaN or infinite
    ValuePlace nonFinitePlace;   ///< the first of them
    float nonFiniteValue = 0, nonFiniteReference = 0;
};

/// Throws Error(badInput) if data windows or channels differ, or if there are no pixels.
void checkComparable(const Image& image, const Image& reference);

/// Throws what checkComparable throws.
Metrics compare(const Image& image, const Image& reference);

} // namespace slant
