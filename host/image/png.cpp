#include "image/png.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/read_file.h"
#include "image/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <png.h>

namespace slant {
namespace {

constexpr std::size_t kMaxPixels = std::size_t(1) << 27;
constexpr int kMaxSide = 1 << 24;
/// Deflate packs at most 1032 bytes into one (a match of 258 bytes in two bits), and a pixel has at least one
/// bit.
constexpr std::size_t kMaxPixelsPerByte = 1032 * 8;

/// Decodes with libpng, which reports errors by longjmp: the functions that call setjmp hold no object with a
/// destructor, and leave the message in `message_`.
class PngReader {
public:
    PngReader(const std::string& path, const std::string& bytes) : path_(path), bytes_(bytes) {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
        if (!info_) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            throw Error(ErrorCode::resources, {path}, "no memory to read it");
        }
    }
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    Image read() {
        if (!readHeader()) throw damaged();
        const std::size_t width = png_get_image_width(png_, info_),
                          height = png_get_image_height(png_, info_);
        if (width * height > kMaxPixels)
            throw badInput({path_}, "{}x{} pixels are more than the 2^27 that are read", width, height);
        if (width * height / kMaxPixelsPerByte > bytes_.size())
            throw badInput({path_}, "is a damaged PNG file: too short for {}x{} pixels", width, height);
        const std::array<std::vector<std::string>, 4> names{
            {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}}};
        const Rect window{0, 0, int(width), int(height)};
        Image image(window, names.at(png_get_channels(png_, info_) - 1u));

        const std::size_t rowBytes = png_get_rowbytes(png_, info_);
        std::vector<png_byte> samples(rowBytes * height);
        std::vector<png_bytep> rows(height);
        for (std::size_t y = 0; y < height; ++y) rows[y] = samples.data() + y * rowBytes;
        if (!readRows(rows.data())) throw damaged();

        const bool wide = png_get_bit_depth(png_, info_) == 16;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i] =
                wide ? float(samples[2 * i] << 8 | samples[2 * i + 1]) / 65535.f : float(samples[i]) / 255.f;
        return image;
    }

private:
    bool readHeader() {
        if (setjmp(png_jmpbuf(png_))) return false;
        png_set_read_fn(png_, this, onRead);
        png_set_user_limits(png_, kMaxSide, kMaxSide);
        png_read_info(png_, info_);
        png_set_expand(png_); // palettes, fewer than 8 bits, transparent colours
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }

    bool readRows(png_bytepp rows) {
        if (setjmp(png_jmpbuf(png_))) return false;
        png_read_image(png_, rows);
        png_read_end(png_, nullptr);
        return true;
    }

    Error damaged() const { return badInput({path_}, "is a damaged PNG file: {}", message_.data()); }

    static void onRead(png_structp png, png_bytep data, std::size_t count) {
        auto& self = *static_cast<PngReader*>(png_get_io_ptr(png));
        if (count > self.bytes_.size() - self.position_) png_error(png, "it ends early");
        std::memcpy(data, self.bytes_.data() + self.position_, count);
        self.position_ += count;
    }

    [[noreturn]] static void onError(png_structp png, png_const_charp message) {
        auto& text = static_cast<PngReader*>(png_get_error_ptr(png))->message_;
        std::strncpy(text.data(), message, text.size() - 1);
        png_longjmp(png, 1);
    }

    static void onWarning(png_structp, png_const_charp) {}

    const std::string& path_;
    const std::string& bytes_;
    std::size_t position_ = 0;
    std::array<char, 256> message_{};
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

std::uint8_t toByte(float linear) {
    // The comparison sends NaN to black.
    const float clipped = linear > 0 ? std::min(linear, 1.f) : 0.f;
    return std::uint8_t(std::lround(255 * srgbFromLinear(clipped)));
}

} // namespace

Bitmap toSrgb8(const Image& image, float exposureStops) {
    std::vector<int> sources = {image.channel("R"), image.channel("G"), image.channel("B")};
    if (*std::min_element(sources.begin(), sources.end()) < 0) sources = {0};
    Bitmap bitmap{image.width(), image.height(), int(sources.size()), {}};
    bitmap.bytes.reserve(image.dataWindow.area() * sources.size());
    const float scale = std::exp2(exposureStops);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (const int c : sources) bitmap.bytes.push_back(toByte(image.at(x, y, c) * scale));
    return bitmap;
}

void writePng(const std::string& path, const Bitmap& bitmap) {
    AtomicFile file(path);
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    image.width = png_uint_32(bitmap.width);
    image.height = png_uint_32(bitmap.height);
    image.format = bitmap.channels == 1 ? PNG_FORMAT_GRAY : PNG_FORMAT_RGB;
    std::size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<char> encoded(size);
    if (!png_image_write_to_memory(&image, encoded.data(), &size, 0, bitmap.bytes.data(), 0, nullptr))
        throw Error(ErrorCode::resources, {path}, fmt::format("cannot encode as PNG: {}", image.message));
    file.write(encoded.data(), size);
    file.commit();
}

Image readPng(const std::string& path) {
    const std::string bytes = readFile(path);
    constexpr std::size_t kSignatureBytes = 8;
    if (bytes.size() < kSignatureBytes ||
        png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, kSignatureBytes) != 0)
        throw badInput({path}, "is not a PNG file");
    return PngReader(path, bytes).read();
}

} // namespace slant
