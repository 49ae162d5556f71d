#include "image/radiance.h"

#include "base/error.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace slant {
namespace {

constexpr std::size_t kMaxPixels = std::size_t(1) << 27;
/// A row packs at most 127 pixels of four components into eight bytes.
constexpr std::size_t kMaxPixelsPerByte = 16;
/// Rows of other widths are never packed.
constexpr int kLeastPacked = 8, kMostPacked = 32767;

class RadianceReader {
public:
    RadianceReader(std::string_view bytes, const std::string& path) : rest_(bytes), path_(path) {}

    Image read() {
        while (!line().empty()) {
        } // FORMAT, EXPOSURE and others
        const auto [width, height] = size(line());
        Image image = Image::rgb(width, height);
        std::vector<Texel> row(std::size_t(width), Texel{});
        for (int y = 0; y < height; ++y) {
            readRow(row);
            for (int x = 0; x < width; ++x) {
                const Texel& texel = row[std::size_t(x)];
                // The exponent counts from 2^-128, for components of 8 bits.
                const float unit = texel[3] == 0 ? 0.f : std::ldexp(1.f, texel[3] - (128 + 8));
                for (int c = 0; c < 3; ++c) image.at(x, y, c) = unit * float(texel[std::size_t(c)]);
            }
        }
        return image;
    }

private:
    using Texel = std::array<std::uint8_t, 4>;

    std::string_view line() {
        const std::size_t end = rest_.find('\n');
        if (end == std::string_view::npos) throw badInput({path_}, "the Radiance picture is cut short");
        const std::string_view found = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        return found;
    }

    /// "-Y height +X width"
    std::pair<int, int> size(std::string_view text) const {
        const auto number = [&](std::string_view before) {
            int value = 0;
            if (!text.starts_with(before)) return 0;
            text.remove_prefix(before.size());
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            text.remove_prefix(std::size_t(end - text.data()));
            return error == std::errc() ? value : 0;
        };
        const int height = number("-Y "), width = number(" +X ");
        if (width <= 0 || height <= 0)
            throw badInput({path_}, "the Radiance picture is damaged, or its rows are not from the top left");
        const std::size_t pixels = std::size_t(width) * std::size_t(height);
        if (pixels > kMaxPixels)
            throw badInput({path_}, "{}x{} pixels are more than the limit of {}", width, height, kMaxPixels);
        if (pixels / kMaxPixelsPerByte > rest_.size())
            throw badInput({path_}, "the Radiance picture is cut short");
        return {width, height};
    }

    std::uint8_t byte() {
        if (rest_.empty()) throw badInput({path_}, "the Radiance picture is cut short");
        const auto value = std::uint8_t(rest_.front());
        rest_.remove_prefix(1);
        return value;
    }

    void readRow(std::vector<Texel>& row) {
        const int width = int(row.size());
        const std::string_view mark("\x02\x02", 2);
        if (width < kLeastPacked || width > kMostPacked || !rest_.starts_with(mark)) {
            for (Texel& texel : row)
                for (std::uint8_t& value : texel) value = byte();
            return;
        }
        rest_.remove_prefix(mark.size());
        const int high = byte(), low = byte();
        if (256 * high + low != width)
            throw badInput({path_}, "a row of the Radiance picture has a wrong width");
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t x = 0; x < row.size();) {
                const std::size_t code = byte();
                const bool isRun = code > 128;
                const std::size_t count = isRun ? code - 128 : code;
                if (count == 0 || count > row.size() - x)
                    throw badInput({path_}, "a row of the Radiance picture is damaged");
                const std::uint8_t repeated = isRun ? byte() : 0;
                for (const std::size_t end = x + count; x < end; ++x) row[x][c] = isRun ? repeated : byte();
            }
    }

    std::string_view rest_;
    const std::string& path_;
};

} // namespace

Image parseRadiance(std::string_view bytes, const std::string& path) {
    return RadianceReader(bytes, path).read();
}

} // namespace slant
