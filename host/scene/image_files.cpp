#include "scene/image_files.h"

#include "image/picture.h"
#include "image/srgb.h"

#include <algorithm>
#include <cmath>

namespace slant {
namespace {

using Kind = ColourEncoding::Kind;

float decoded(float value, ColourEncoding encoding) {
    switch (encoding.kind) {
    case Kind::linear:
        return value;
    case Kind::gamma:
        return std::pow(value, encoding.exponent);
    default:
        return linearFromSrgb(value);
    }
}

/// Channels of the colour: R, G, B, or the first one for grey.
std::vector<int> colourChannels(const Image& image) {
    const std::vector<int> rgb{image.channel("R"), image.channel("G"), image.channel("B")};
    if (std::none_of(rgb.begin(), rgb.end(), [](int c) { return c < 0; })) return rgb;
    const int grey = image.channel("Y");
    if (grey >= 0 || image.channelCount() == 1) return {std::max(grey, 0)};
    return {};
}

} // namespace

Image readImageFile(const std::string& path, ColourEncoding encoding, bool average, const Position& where) {
    Picture picture;
    try {
        picture = readPicture(path);
    } catch (const Error& error) {
        throw Error(error.code(), where, error.what());
    }
    const auto& [file, encoded] = picture;
    const std::vector<int> colours = colourChannels(file);
    if (colours.empty()) throw badInput(where, "{} has neither channels R, G, B nor Y", path);

    const bool grey = average || colours.size() == 1;
    using Names = std::vector<std::string>;
    Image image({0, 0, file.width(), file.height()}, grey ? Names{"Y"} : Names{"R", "G", "B"});
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            float sum = 0;
            for (std::size_t c = 0; c < colours.size(); ++c) {
                // pbrt encodes integer images only; floats are linear whatever the file says.
                const float stored = file.at(x, y, colours[c]);
                const float value = encoded ? decoded(stored, encoding) : stored;
                if (!std::isfinite(value))
                    throw badInput(where, "{} has a value that is not finite at pixel {}, {}", path, x, y);
                sum += value;
                if (!grey) image.at(x, y, int(c)) = value;
            }
            if (grey) image.at(x, y, 0) = sum / float(colours.size());
        }
    return image;
}

} // namespace slant
