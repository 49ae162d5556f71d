#include "image/image.h"

#include "base/error.h"

#include <algorithm>
#include <new>

namespace slant {

Image::Image(Rect window, std::vector<std::string> names)
    : dataWindow(window), displayWindow(window), channels(std::move(names)) {
    try {
        pixels.resize(dataWindow.area() * channels.size());
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::resources,
                    fmt::format("no memory for an image of {}x{} pixels", width(), height()));
    }
}

Image Image::rgb(int width, int height) {
    return Image({0, 0, width, height}, {"R", "G", "B"});
}

int Image::channel(const std::string& name) const {
    const auto found = std::find(channels.begin(), channels.end(), name);
    return found == channels.end() ? -1 : int(found - channels.begin());
}

Image Image::withChannels(std::vector<std::string> names) const {
    Image part(dataWindow, std::move(names));
    part.displayWindow = displayWindow;
    std::vector<std::size_t> sources;
    for (const std::string& name : part.channels) sources.push_back(std::size_t(channel(name)));
    for (std::size_t i = 0; i < part.pixels.size(); ++i)
        part.pixels[i] = pixels[i / sources.size() * channels.size() + sources[i % sources.size()]];
    return part;
}

Image Image::withMoreChannels(std::span<const std::string> names) const {
    std::vector<std::string> all = channels;
    all.insert(all.end(), names.begin(), names.end());
    Image wider(dataWindow, std::move(all));
    wider.displayWindow = displayWindow;
    const std::size_t before = channels.size(), after = wider.channels.size();
    for (std::size_t pixel = 0; pixel < dataWindow.area(); ++pixel)
        std::copy_n(pixels.data() + before * pixel, before, wider.pixels.data() + after * pixel);
    return wider;
}

} // namespace slant
