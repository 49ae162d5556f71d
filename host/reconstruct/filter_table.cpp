#include "reconstruct/filter_table.h"

#include "base/error.h"
#include "scene/filter_reach.h"

#include <cmath>
#include <numbers>

namespace slant {
namespace {

double gaussian(double x, double sigma) {
    return std::exp(-x * x / (2 * sigma * sigma)) / (sigma * std::sqrt(2 * std::numbers::pi));
}

/// Mitchell and Netravali 1988, eq. 8, over [-2, 2].
double mitchell(double x, double b, double c) {
    if (x <= 1) return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b)) / 6;
    if (x <= 2)
        return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x +
                (8 * b + 24 * c)) /
               6;
    return 0;
}

double sinc(double x) {
    return x < 1e-5 ? 1 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x);
}

/// Of a filter of radius `radius` over the pixel `offset` pixels away.
double meanOverPixel(const PixelFilter& filter, double radius, int offset) {
    double sum = 0;
    for (int q = 0; q < kSubpixels; ++q)
        sum += evaluateFilterAxis(filter, radius, std::abs(offset + (q + 0.5) / kSubpixels - 0.5));
    return sum / kSubpixels;
}

} // namespace

double evaluateFilterAxis(const PixelFilter& filter, double radius, double x) {
    if (x > radius) return 0;
    switch (filter.kind) {
    case FilterKind::box:
        return 1;
    case FilterKind::triangle:
        return radius - x;
    case FilterKind::gaussian:
        return std::max(0.0, gaussian(x, filter.sigma) - gaussian(radius, filter.sigma));
    case FilterKind::mitchell:
        return mitchell(2 * x / radius, filter.b, filter.c);
    case FilterKind::sinc:
        return sinc(x) * sinc(x / filter.tau);
    }
    return 0;
}

FilterTable makeFilterTable(const PixelFilter& filter) {
    FilterTable table;
    for (int axis = 0; axis < 2; ++axis) {
        const double radius = filter.radius[axis];
        if (!(radius > 0 && radius <= 16))
            throw Error(ErrorCode::badInput,
                        fmt::format("pixel filter radius must be in (0, 16], not {}", radius));
        table.length[axis] = int(std::ceil(radius * kSubpixels));
        table.reach[axis] = filterReach(filter)[axis];
        for (int i = 0; i < table.length[axis]; ++i)
            table.weights.push_back(float(evaluateFilterAxis(filter, radius, (i + 0.5) / kSubpixels)));
    }
    for (int axis = 0; axis < 2; ++axis)
        for (int offset = 0; offset <= table.reach[axis]; ++offset)
            table.weights.push_back(float(meanOverPixel(filter, filter.radius[axis], offset)));
    return table;
}

} // namespace slant
