#include "scene/latlong.h"

#include "image/octahedral.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace slant {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kLooks = 4; ///< into the image for each pixel, along each side

/// Bilinear; around the sphere, but not over the poles.
glm::dvec3 lookUp(const Image& image, const glm::dvec3& d) {
    const double turn = std::atan2(d.y, d.x) / (2 * kPi);
    const double x = (turn < 0 ? turn + 1 : turn) * image.width() - 0.5;
    const double y = std::acos(std::clamp(d.z, -1.0, 1.0)) / kPi * image.height() - 0.5;
    const auto texel = [&](double column, double row) {
        const int i = (int(column) + image.width()) % image.width();
        const int j = std::clamp(int(row), 0, image.height() - 1);
        return glm::dvec3(image.at(i, j, 0), image.at(i, j, 1), image.at(i, j, 2));
    };
    const double left = std::floor(x), top = std::floor(y);
    return glm::mix(glm::mix(texel(left, top), texel(left + 1, top), x - left),
                    glm::mix(texel(left, top + 1), texel(left + 1, top + 1), x - left), y - top);
}

} // namespace

Image octahedralOfLatLong(const Image& latLong) {
    const int side = int(std::lround(std::sqrt(double(latLong.width()) * latLong.height())));
    Image image = Image::rgb(side, side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            glm::dvec3 sum(0);
            for (int look = 0; look < kLooks * kLooks; ++look) {
                const glm::dvec2 within((look % kLooks + 0.5) / kLooks, (look / kLooks + 0.5) / kLooks);
                const glm::vec2 place((glm::dvec2(x, y) + within) / double(side));
                sum += lookUp(latLong, glm::dvec3(equalAreaSquareToSphere(place)));
            }
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = float(sum[c] / (kLooks * kLooks));
        }
    return image;
}

} // namespace slant
