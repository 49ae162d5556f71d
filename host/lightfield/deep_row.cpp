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

DeepRow::DeepRow(const LightField& field) : field_(field), counts_(std::size_t(field.bounds.width())) {
    buffer_.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, originOf(counts_.data(), field.bounds.x0), sizeof(unsigned), 0));
}

void DeepRow::add(std::span<const DeepChannel> channels, void* samples, std::size_t stride) {
    for (const DeepChannel& channel : channels) {
        channels_.push_back(
            {static_cast<char*>(samples) + channel.offset, stride, std::vector<char*>(counts_.size())});
        buffer_.insert(channel.name,
                       Imf::DeepSlice(Imf::FLOAT, originOf(channels_.back().pixels.data(), field_.bounds.x0),
                                      sizeof(char*), 0, stride));
    }
}

void DeepRow::moveTo(int y) {
    firstPixel_ = std::size_t(y - field_.bounds.y0) * counts_.size();
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        const std::size_t sample = field_.firstSample(firstPixel_ + i);
        counts_[i] = unsigned(field_.samplesOf(firstPixel_ + i));
        for (Channel& channel : channels_) channel.pixels[i] = channel.first + sample * channel.stride;
    }
}

void DeepRow::checkCounts(const FileLocation& where) const {
    for (std::size_t i = 0; i < counts_.size(); ++i)
        if (counts_[i] != field_.samplesOf(firstPixel_ + i))
            throw badInput(where, "changed while it was read");
}

Imf::DeepFrameBuffer countBuffer(std::vector<unsigned>& counts, const Rect& bounds) {
    Imf::DeepFrameBuffer buffer;
    const std::ptrdiff_t first = std::ptrdiff_t(bounds.y0) * bounds.width() + bounds.x0;
    buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, originOf(counts.data(), first), sizeof(unsigned),
                                             sizeof(unsigned) * std::size_t(bounds.width())));
    return buffer;
}

} // namespace slant
