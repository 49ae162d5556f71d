// One scanline of a deep file at a time, straight from and into interleaved samples.
#pragma once
#include "base/error.h"
#include "lightfield/deep_channels.h"

#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <span>
#include <string>
#include <vector>

namespace slant {

/// OpenEXR asks for the address of every pixel's first sample in every channel. These addresses are kept for
/// one scanline, the same for all, and set anew by moveTo.
class DeepRow {
public:
    /// Takes bounds and counts of samples from the field, which must outlive it.
    explicit DeepRow(const LightField& field);
    DeepRow(const DeepRow&) = delete;
    DeepRow& operator=(const DeepRow&) = delete;

    /// Channels of samples, `stride` bytes apart. The field's samples begin at `samples`.
    void add(std::span<const DeepChannel> channels, void* samples, std::size_t stride);
    void moveTo(int y);
    /// Throws Error(badInput) where the counts that were read last for this row are not those of the field:
    /// there is no room for more.
    void checkCounts(const FileLocation& where) const;
    const Imf::DeepFrameBuffer& frameBuffer() const { return buffer_; }

private:
    struct Channel {
        char* first; ///< of the whole field
        std::size_t stride;
        std::vector<char*> pixels; ///< of this row
    };

    const LightField& field_;
    std::size_t firstPixel_ = 0;   ///< of this row
    std::vector<unsigned> counts_; ///< of this row
    std::vector<Channel> channels_;
    Imf::DeepFrameBuffer buffer_;
};

/// Counts of samples in every pixel of `bounds`, row by row.
Imf::DeepFrameBuffer countBuffer(std::vector<unsigned>& counts, const Rect& bounds);

} // namespace slant
