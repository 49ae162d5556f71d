#include "lightfield/deep_row.h"

#include <cstdint>

namespace slant {
namespace {

/// The address that pixel (0, 0) would have: OpenEXR counts from there, though it may lie outside.
template <typename T>
char* originOf(T* first, std::ptrdiff_t items) {
    return reinterpret_cast<char*>(reinterpret_cast<std::uintptr_t>(first) -
                                   std::uintptr_t(items) * sizeof(T));
}

} // namespace

DeepRow::DeepRow(const Rect& bounds, int samplesPerPixel)
    : bounds_(bounds), samplesPerPixel_(samplesPerPixel),
      counts_(std::size_t(bounds.width()), unsigned(samplesPerPixel)) {
    buffer_.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, originOf(counts_.data(), bounds_.x0), sizeof(unsigned), 0));
}

void DeepRow::add(std::span<const DeepChannel> channels, void* samples, std::size_t stride,
                  std::size_t rowBytes) {
    for (const DeepChannel& channel : channels) {
        channels_.push_back({static_cast<char*>(samples) + channel.offset, stride, rowBytes,
                             std::vector<char*>(std::size_t(bounds_.width()))});
        buffer_.insert(channel.name,
                       Imf::DeepSlice(Imf::FLOAT, originOf(channels_.back().pixels.data(), bounds_.x0),
                                      sizeof(char*), 0, stride));
    }
}

void DeepRow::moveTo(int y) {
    for (Channel& channel : channels_) {
        char* first = channel.first + std::size_t(y - bounds_.y0) * channel.rowBytes;
        for (char*& pixel : channel.pixels) {
            pixel = first;
            first += std::size_t(samplesPerPixel_) * channel.stride;
        }
    }
}

void DeepRow::checkCounts(const FileLocation& where) const {
    for (const unsigned count : counts_)
        if (count != unsigned(samplesPerPixel_)) throw badInput(where, "changed while it was read");
}

Imf::DeepFrameBuffer countBuffer(std::vector<unsigned>& counts, const Rect& bounds) {
    Imf::DeepFrameBuffer buffer;
    const std::ptrdiff_t first = std::ptrdiff_t(bounds.y0) * bounds.width() + bounds.x0;
    buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, originOf(counts.data(), first), sizeof(unsigned),
                                             sizeof(unsigned) * std::size_t(bounds.width())));
    return buffer;
}

} // namespace slant
