#include "image/metrics.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slant {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

ValuePlace placeOf(const Image& image, std::size_t index) {
    const std::size_t channels = image.channels.size(), width = std::size_t(image.width());
    const std::size_t pixel = index / channels;
    return {image.dataWindow.x0 + int(pixel % width), image.dataWindow.y0 + int(pixel / width),
            int(index % channels)};
}

/// Whether anything was counted.
bool countNonFinite(const Image& image, const Image& reference, Metrics& metrics) {
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const float a = image.pixels[i], b = reference.pixels[i];
        if (std::isfinite(a) && std::isfinite(b)) continue;
        if (metrics.nonFinite++ > 0) continue;
        metrics.nonFinitePlace = placeOf(image, i);
        metrics.nonFiniteValue = a;
        metrics.nonFiniteReference = b;
    }
    return metrics.nonFinite > 0;
}

/// Nearest rank; reorders `values`.
double percentile99(std::vector<double>& values) {
    const std::size_t rank = (99 * values.size() + 99) / 100;
    const auto place = values.begin() + std::ptrdiff_t(rank) - 1;
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

double relativeDrift(double sum, double referenceSum) {
    if (sum == referenceSum) return 0;
    return (sum - referenceSum) / std::abs(referenceSum);
}

void addErrors(const Image& image, const Image& reference, Metrics& metrics) {
    const std::size_t count = image.pixels.size(), channels = image.channels.size();
    std::vector<double> absolute(count);
    std::size_t worst = 0;
    double squares = 0, relativeSquares = 0, sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double b = reference.pixels[i], error = image.pixels[i] - b;
        absolute[i] = std::abs(error);
        if (absolute[i] > absolute[worst]) worst = i;
        squares += error * error;
        relativeSquares += error * error / (b * b + kRelMseFloor);
        sum += absolute[i];
    }
    metrics.mse = squares / double(count);
    metrics.relMse = relativeSquares / double(count);
    metrics.psnr = -10 * std::log10(metrics.mse);
    metrics.mae = sum / double(count);
    metrics.maxAbs = absolute[worst];
    metrics.maxPlace = placeOf(image, worst);
    metrics.maxValue = image.pixels[worst];
    metrics.maxReference = reference.pixels[worst];
    metrics.p99 = percentile99(absolute);

    std::vector<double> sums(channels), referenceSums(channels);
    for (std::size_t i = 0; i < count; ++i) {
        sums[i % channels] += image.pixels[i];
        referenceSums[i % channels] += reference.pixels[i];
    }
    double total = 0, referenceTotal = 0;
    for (std::size_t c = 0; c < channels; ++c) {
        metrics.channelDrift.push_back(relativeDrift(sums[c], referenceSums[c]));
        total += sums[c];
        referenceTotal += referenceSums[c];
    }
    metrics.drift = relativeDrift(total, referenceTotal);
}

} // namespace

void checkComparable(const Image& image, const Image& reference) {
    const Rect &a = image.dataWindow, &b = reference.dataWindow;
    if (a.width() != b.width() || a.height() != b.height())
        throw badInput({}, "images of {}x{} and {}x{} pixels cannot be compared", a.width(), a.height(),
                       b.width(), b.height());
    if (a != b)
        throw badInput({}, "data windows at ({}, {}) and ({}, {}) cannot be compared", a.x0, a.y0, b.x0,
                       b.y0);
    if (image.channels != reference.channels)
        throw badInput({}, "images with channels {} and {} cannot be compared",
                       fmt::join(image.channels, " "), fmt::join(reference.channels, " "));
    if (image.pixels.empty()) throw badInput({}, "images without pixels cannot be compared");
}

Metrics compare(const Image& image, const Image& reference) {
    checkComparable(image, reference);
    Metrics metrics;
    if (countNonFinite(image, reference, metrics)) {
        metrics.mse = metrics.relMse = metrics.psnr = metrics.mae = metrics.p99 = metrics.maxAbs =
            metrics.drift = kNaN;
        metrics.channelDrift.assign(image.channels.size(), kNaN);
    } else {
        addErrors(image, reference, metrics);
    }
    return metrics;
}

} // namespace slant
