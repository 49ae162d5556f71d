// Checks the sizes that an OpenEXR file claims against those it has: OpenEXR allocates before it reads.
#pragma once
#include "base/input_file.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfIO.h>
#include <array>
#include <bit>
#include <cstdint>

namespace slant {

/// Bytes that one compressed byte can stand for (deflate), with room for the rest of the file.
inline constexpr std::uint64_t kLargestRatio = 1100;
/// Of the version field, behind the magic number; the header follows it.
inline constexpr std::uint64_t kVersionPlace = 4;

/// Throws Iex::InputExc beyond the end. The file must outlive it.
class FileStream final : public Imf::IStream {
public:
    explicit FileStream(const InputFile& file) : IStream(file.path().c_str()), file_(file) {}
    bool read(char data[], int count) override {
        if (position_ > file_.size() || std::uint64_t(count) > file_.size() - position_)
            throw Iex::InputExc("it ends early");
        file_.read(position_, data, std::size_t(count));
        position_ += std::uint64_t(count);
        return position_ < file_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

private:
    const InputFile& file_;
    std::uint64_t position_ = 0;
};

/// Little-endian, as OpenEXR stores them and as the machine has them.
template <typename Number>
Number readNumber(FileStream& stream) {
    static_assert(std::endian::native == std::endian::little);
    std::array<char, sizeof(Number)> bytes;
    stream.read(bytes.data(), int(bytes.size()));
    return std::bit_cast<Number>(bytes);
}

/// Throws Iex::InputExc unless every attribute of the header fits into the file and has the size of its type.
void checkAttributes(const InputFile& file);

/// Throws Iex::InputExc unless each of the `count` deep scanlines, whose places begin at `table`, fits into
/// the file.
void checkScanlines(const InputFile& file, std::uint64_t table, int count);

} // namespace slant
