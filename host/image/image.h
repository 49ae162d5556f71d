// A floating-point image of named channels, and where it lies on the film.
#pragma once
#include "base/rect.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace slant {

/// Row-major, channels interleaved, linear values (Rec.709 primaries for R, G, B). `dataWindow` is the
/// rectangle of pixels that are held, `displayWindow` the whole film (they differ for crops).
class Image {
public:
    Image() = default;
    /// All zero. Throws Error(resources) if it cannot be allocated.
    Image(Rect dataWindow, std::vector<std::string> channels);
    /// Three channels R, G, B, display window = data window = [0, width) x [0, height).
    static Image rgb(int width, int height);

    int width() const { return dataWindow.width(); }
    int height() const { return dataWindow.height(); }
    int channelCount() const { return int(channels.size()); }
    /// Index of a channel by name, -1 if there is none.
    int channel(const std::string& name) const;

    /// x, y count from the top left of the data window.
    float& at(int x, int y, int c) { return pixels[index(x, y, c)]; }
    float at(int x, int y, int c) const { return pixels[index(x, y, c)]; }

    /// The channels of these names, all of which must exist.
    Image withChannels(std::vector<std::string> names) const;
    /// The same with further channels, all zero, behind its own.
    Image withMoreChannels(std::span<const std::string> names) const;

    Rect dataWindow;
    Rect displayWindow;
    std::vector<std::string> channels;
    std::vector<float> pixels;

private:
    std::size_t index(int x, int y, int c) const {
        return (std::size_t(y) * std::size_t(width()) + std::size_t(x)) * channels.size() + std::size_t(c);
    }
};

} // namespace slant
