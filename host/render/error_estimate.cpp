#include "render/error_estimate.h"

#include "image/metrics.h"
#include "lightfield/parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slant {
namespace {

/// Few are enough: both halves look through the same lens positions, and what they miss cancels out.
constexpr int kOutputsPerPixel = 8;
/// A pixel never gets more than so many times its samples: its error is the luck of a few.
constexpr double kMostTimes = 16;

/// Takes the mean around each pixel: weights 1 4 6 4 1 in both directions, of pixels `stride` apart.
void smooth(std::vector<double>& plane, int width, int height, int stride = 1) {
    const auto pass = [&](int dx, int dy) {
        std::vector<double> mean(plane.size());
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const auto at = [&](int steps) {
                    const int i = std::clamp(x + steps * stride * dx, 0, width - 1),
                              j = std::clamp(y + steps * stride * dy, 0, height - 1);
                    return plane[std::size_t(j) * std::size_t(width) + std::size_t(i)];
                };
                mean[std::size_t(y) * std::size_t(width) + std::size_t(x)] =
                    (at(-2) + at(2) + 4 * (at(-1) + at(1)) + 6 * at(0)) / 16;
            }
        plane.swap(mean);
    };
    pass(1, 0);
    pass(0, 1);
}

/// Of one value of the whole picture, from those of its halves.
double squaredError(float a, float b) {
    const double difference = double(a) - double(b);
    return difference * difference / 4;
}

double relativeSquaredError(float a, float b) {
    const double mean = (double(a) + double(b)) / 2;
    return squaredError(a, b) / (mean * mean + kRelMseFloor);
}

/// Samples of a pixel in proportion to what it needs, but not fewer than it has.
double wanted(double perNeed, double need, std::uint32_t before) {
    return std::clamp(perNeed * need, double(before), kMostTimes * double(before));
}

/// The factor from needs to samples with which there are `total` of them, or as many as pixels may have.
double samplesPerNeed(std::span<const double> needs, std::span<const std::uint32_t> before, double total) {
    const double most = *std::ranges::max_element(needs);
    double low = 0, high = most > 0 ? kMostTimes * total / most : 0;
    for (int i = 0; i < std::numeric_limits<double>::digits; ++i) {
        const double middle = (low + high) / 2;
        double sum = 0;
        for (std::size_t k = 0; k < needs.size(); ++k) sum += wanted(middle, needs[k], before[k]);
        (sum < total ? low : high) = middle;
    }
    return low;
}

} // namespace

ErrorEstimate::ErrorEstimate(Backend& backend, const LightField& field, const ReconstructOptions& options,
                             const LensView& view, bool compareWithCpu, Monitor& monitor,
                             ReconstructReport& report, std::vector<Agreement>& agreements) {
    ReconstructOptions few = options;
    few.outputsPerPixel = std::min(options.outputsPerPixel, kOutputsPerPixel);
    ReconstructReport ofHalves;
    const Stopwatch watch;
    for (int i = 0; i < 2; ++i) {
        const LightField half = halfOf(field, i);
        FieldPictures pictures(backend, half, few, compareWithCpu);
        halves_[std::size_t(i)] = pictures.colours(view, monitor, ofHalves);
        for (const Agreement& agreement : pictures.takeAgreements()) agreements.push_back(agreement);
    }
    StageStats& stage = report.stage("error estimate", "outputs");
    stage.seconds += watch.seconds();
    stage.items += ofHalves.outputs;
}

double ErrorEstimate::relMse() const {
    const std::vector<float>&a = halves_[0].pixels, &b = halves_[1].pixels;
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += relativeSquaredError(a[i], b[i]);
    return sum / double(a.size());
}

void ErrorEstimate::addChannels(Image& image) const {
    const int width = image.width(), height = image.height();
    const std::array<std::string, 3> names = {"error.R", "error.G", "error.B"};
    Image wider = image.withMoreChannels(names);
    for (int c = 0; c < 3; ++c) {
        std::vector<double> squares(image.dataWindow.area());
        for (std::size_t i = 0; i < squares.size(); ++i) {
            const std::size_t value = 3 * i + std::size_t(c);
            squares[i] = squaredError(halves_[0].pixels[value], halves_[1].pixels[value]);
        }
        smooth(squares, width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                wider.at(x, y, image.channelCount() + c) =
                    float(std::sqrt(squares[std::size_t(y) * std::size_t(width) + std::size_t(x)]));
    }
    image = std::move(wider);
}

std::vector<std::uint32_t> ErrorEstimate::place(std::span<const std::uint32_t> before,
                                                std::uint64_t extra) const {
    std::vector<double> needs(before.size(), 0); // squared, of one sample
    double total = double(extra);
    for (std::size_t i = 0; i < needs.size(); ++i) {
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
            needs[i] += double(before[i]) * relativeSquaredError(halves_[0].pixels[c], halves_[1].pixels[c]);
        total += double(before[i]);
    }
    // Widely, for a pixel that decides on its own samples alone is biased: it keeps what luck made alike.
    for (const int stride : {1, 2}) smooth(needs, halves_[0].width(), halves_[0].height(), stride);
    for (double& need : needs) need = std::sqrt(need);
    const double factor = samplesPerNeed(needs, before, total);
    std::vector<std::uint32_t> counts(before.size());
    double rest = 0; // what rounding has left so far
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double more = wanted(factor, needs[i], before[i]) - double(before[i]) + rest;
        counts[i] = std::uint32_t(more);
        rest = more - double(counts[i]);
    }
    return counts;
}

} // namespace slant
