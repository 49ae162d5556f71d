#include "image/flip.h"

#include "base/parallel.h"
#include "image/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>

namespace slant {
namespace {

using glm::dvec3;
using Plane = std::vector<float>; ///< one value per pixel, row-major
using Planes = std::array<Plane, 3>;
using Kernel = std::vector<double>; ///< taps from -radius to radius

// Sections 4.1.3 and 4.2 and Table 1 of the paper.
constexpr double kColorExponent = 0.7, kColorKnee = 0.4, kColorKneeValue = 0.95;
constexpr double kFeatureWidthDegrees = 0.082, kFeatureExponent = 0.5;
/// The largest scale b of all spatial filters: it gives their radius.
constexpr double kWidestScale = 0.04;

// ---------------------------------------------------------------- colour

/// XYZ relative to the white point from linear Rec.709: from the chromaticities of the primaries and of D65.
glm::dmat3 relativeXyzFromRgb() {
    const auto xyzOf = [](double x, double y) { return dvec3(x / y, 1, (1 - x - y) / y); };
    const glm::dmat3 primaries(xyzOf(0.64, 0.33), xyzOf(0.30, 0.60), xyzOf(0.15, 0.06));
    const dvec3 white = xyzOf(0.3127, 0.3290);
    const dvec3 scale = glm::inverse(primaries) * white;
    glm::dmat3 matrix;
    for (int c = 0; c < 3; ++c) matrix[c] = primaries[c] * scale[c] / white;
    return matrix;
}

/// The opponent space YCxCz, but for scale and offset, which its linear use here cancels.
dvec3 opponentOf(dvec3 xyz) {
    return {xyz.y, xyz.x - xyz.y, xyz.y - xyz.z};
}
dvec3 xyzOfOpponent(dvec3 o) {
    return {o.x + o.y, o.x, o.x - o.z};
}

/// CIE L*a*b* with the paper's Hunt adjustment: chroma counts less in the dark.
dvec3 huntLabOf(dvec3 xyz) {
    const auto root = [](double t) {
        constexpr double kDelta = 6.0 / 29;
        return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
    };
    const double x = root(xyz.x), y = root(xyz.y), z = root(xyz.z);
    const double lightness = 116 * y - 16;
    return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

/// Abasi, Tehran and Fairchild 2019: city blocks between lightness and chroma.
double hyab(dvec3 a, dvec3 b) {
    const dvec3 d = a - b;
    return std::abs(d.x) + std::hypot(d.y, d.z);
}

/// Compresses a colour difference into [0, 1]; 1 is that of the screen's pure green and blue.
class ColorScale {
public:
    explicit ColorScale(const glm::dmat3& xyzFromRgb)
        : largest_(std::pow(hyab(huntLabOf(xyzFromRgb[1]), huntLabOf(xyzFromRgb[2])), kColorExponent)) {}

    double operator()(double difference) const {
        const double power = std::pow(difference, kColorExponent), knee = kColorKnee * largest_;
        if (power < knee) return kColorKneeValue / knee * power;
        return std::min(1.0, kColorKneeValue + (power - knee) / (largest_ - knee) * (1 - kColorKneeValue));
    }

private:
    double largest_;
};

// ---------------------------------------------------------------- filters

/// Taps f(-radius) ... f(radius), with positive and negative ones scaled to sums of 1 and -1.
template <typename Function>
Kernel makeKernel(int radius, const Function& f) {
    Kernel kernel;
    double positive = 0, negative = 0;
    for (int x = -radius; x <= radius; ++x) {
        kernel.push_back(f(double(x)));
        (kernel.back() > 0 ? positive : negative) += std::abs(kernel.back());
    }
    for (double& tap : kernel)
        if (tap != 0) tap /= tap > 0 ? positive : negative;
    return kernel;
}

/// Both passes of a separable filter; beyond its border a picture goes on as at the border.
Plane filtered(const Plane& plane, int width, int height, const Kernel& alongX, const Kernel& alongY) {
    const auto pass = [=](const Plane& from, const Kernel& kernel, bool vertical) {
        Plane to(from.size());
        const int radius = int(kernel.size() / 2), last = (vertical ? height : width) - 1;
        parallelFor(0, std::size_t(height), 16, [&](std::size_t firstRow, std::size_t lastRow) {
            for (int y = int(firstRow); y < int(lastRow); ++y)
                for (int x = 0; x < width; ++x) {
                    double sum = 0;
                    for (int k = -radius; k <= radius; ++k) {
                        const int at = std::clamp((vertical ? y : x) + k, 0, last);
                        const int index = vertical ? at * width + x : y * width + at;
                        sum += kernel[std::size_t(k + radius)] * double(from[std::size_t(index)]);
                    }
                    to[std::size_t(y * width + x)] = float(sum);
                }
        });
        return to;
    };
    return pass(pass(plane, alongX, false), alongY, true);
}

/// One Gaussian a sqrt(pi/b) exp(-pi^2 d^2 / b) of a contrast sensitivity function, d in degrees.
struct Sensitivity {
    double a, b;
};

/// The sum of two Gaussians over a plane, normalised as a whole.
Plane seen(const Plane& plane, int width, int height, const std::array<Sensitivity, 2>& gaussians,
           double pixelsPerDegree) {
    const double pi = glm::pi<double>();
    const int radius = int(std::ceil(3 * std::sqrt(kWidestScale / (2 * pi * pi)) * pixelsPerDegree));
    Plane result(plane.size());
    std::array<Kernel, 2> kernels;
    std::array<double, 2> weights{};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto [a, b] = gaussians[i];
        const auto gaussian = [=, b = b](double x) {
            return std::exp(-pi * pi * x * x / (b * pixelsPerDegree * pixelsPerDegree));
        };
        double sum = 0;
        for (int x = -radius; x <= radius; ++x) sum += gaussian(x);
        kernels[i] = makeKernel(radius, gaussian);
        weights[i] = a * std::sqrt(pi / b) * sum * sum;
    }
    for (std::size_t i = 0; i < 2; ++i) {
        if (weights[i] == 0) continue;
        const Plane part = filtered(plane, width, height, kernels[i], kernels[i]);
        const auto weight = float(weights[i] / (weights[0] + weights[1]));
        for (std::size_t p = 0; p < part.size(); ++p) result[p] += weight * part[p];
    }
    return result;
}

// ---------------------------------------------------------------- the two views and their difference

/// One of the two flipping pictures, as its viewer sees colours, edges and points.
struct View {
    std::vector<dvec3> colors; ///< Hunt-adjusted L*a*b* behind the spatial filters
    Plane edges, points;       ///< magnitudes of the features
};

/// Linear channels in [0, 1] after the exposure.
dvec3 displayed(const Image& image, std::size_t pixel, const std::array<int, 3>& channels, double gain) {
    const float* values = &image.pixels[pixel * image.channels.size()];
    dvec3 rgb;
    for (int c = 0; c < 3; ++c)
        rgb[c] = std::clamp(gain * double(values[channels[std::size_t(c)]]), 0.0, 1.0);
    return rgb;
}

Planes opponentPlanes(const Image& image, const glm::dmat3& xyzFromRgb, double gain) {
    std::array<int, 3> channels{image.channel("R"), image.channel("G"), image.channel("B")};
    if (std::ranges::min(channels) < 0) channels = {0, 0, 0};
    const std::size_t count = image.dataWindow.area();
    Planes planes{Plane(count), Plane(count), Plane(count)};
    for (std::size_t i = 0; i < count; ++i) {
        const dvec3 opponent = opponentOf(xyzFromRgb * displayed(image, i, channels, gain));
        for (int c = 0; c < 3; ++c) planes[std::size_t(c)][i] = float(opponent[c]);
    }
    return planes;
}

/// Length of the gradient that `kernel` across and `smooth` along it find.
Plane featureMagnitude(const Plane& luminance, int width, int height, const Kernel& kernel,
                       const Kernel& smooth) {
    Plane x = filtered(luminance, width, height, kernel, smooth);
    const Plane y = filtered(luminance, width, height, smooth, kernel);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::hypot(x[i], y[i]);
    return x;
}

View viewOf(const Image& image, const glm::dmat3& xyzFromRgb, const FlipOptions& options) {
    const int width = image.width(), height = image.height();
    const Planes opponent = opponentPlanes(image, xyzFromRgb, std::exp2(double(options.exposureStops)));
    View view;

    constexpr std::array<std::array<Sensitivity, 2>, 3> kSensitivities = {
        {{{{1, 0.0047}, {0, 1e-5}}}, {{{1, 0.0053}, {0, 1e-5}}}, {{{34.1, 0.04}, {13.5, 0.025}}}}};
    Planes filteredPlanes;
    for (std::size_t c = 0; c < 3; ++c)
        filteredPlanes[c] = seen(opponent[c], width, height, kSensitivities[c], options.pixelsPerDegree);
    const glm::dmat3 rgbFromXyz = glm::inverse(xyzFromRgb);
    for (std::size_t i = 0; i < filteredPlanes[0].size(); ++i) {
        const dvec3 xyz = xyzOfOpponent({filteredPlanes[0][i], filteredPlanes[1][i], filteredPlanes[2][i]});
        view.colors.push_back(huntLabOf(xyzFromRgb * glm::clamp(rgbFromXyz * xyz, 0.0, 1.0)));
    }

    const double sigma = kFeatureWidthDegrees / 2 * options.pixelsPerDegree;
    const int radius = int(std::ceil(3 * sigma));
    const auto gaussian = [=](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
    const Kernel smooth = makeKernel(radius, gaussian);
    const Kernel edge = makeKernel(radius, [=](double x) { return -x * gaussian(x); });
    const Kernel point =
        makeKernel(radius, [=](double x) { return (x * x / (sigma * sigma) - 1) * gaussian(x); });
    view.edges = featureMagnitude(opponent[0], width, height, edge, smooth);
    view.points = featureMagnitude(opponent[0], width, height, point, smooth);
    return view;
}

bool isFinite(const Image& image) {
    return std::ranges::all_of(image.pixels, [](float value) { return std::isfinite(value); });
}

} // namespace

Flip flip(const Image& image, const Image& reference, const FlipOptions& options) {
    checkComparable(image, reference);
    Flip result{Image(image.dataWindow, {"FLIP"}), 0};
    std::vector<float>& map = result.map.pixels;
    if (!isFinite(image) || !isFinite(reference)) {
        result.mean = std::numeric_limits<double>::quiet_NaN();
        std::ranges::fill(map, float(result.mean));
        return result;
    }
    const glm::dmat3 xyzFromRgb = relativeXyzFromRgb();
    const ColorScale scale(xyzFromRgb);
    const View a = viewOf(image, xyzFromRgb, options), b = viewOf(reference, xyzFromRgb, options);
    for (std::size_t i = 0; i < map.size(); ++i) {
        const double color = scale(hyab(a.colors[i], b.colors[i]));
        const double feature =
            std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
        map[i] = float(std::pow(color, 1 - std::pow(feature / std::sqrt(2), kFeatureExponent)));
        result.mean += double(map[i]);
    }
    result.mean /= double(map.size());
    return result;
}

} // namespace slant
