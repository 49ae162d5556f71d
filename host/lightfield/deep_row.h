// One scanline at a time of a deep file, straight from and into interleaved samples.
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
    /// Every pixel of `bounds` has `samplesPerPixel` samples.
    DeepRow(const Rect& bounds, int samplesPerPixel);
    DeepRow(const DeepRow&) = delete;
    DeepRow& operator=(const DeepRow&) = delete;

    /// Channels of samples that begin at `samples`, `stride` bytes apart, those of a row `rowBytes` after
    /// those of the row before.
    void add(std::span<const DeepChannel> channels, void* samples, std::size_t stride, std::size_t rowBytes);
    void moveTo(int y);
    /// Throws Error(badInput) where the counts that were read last for a row are not samplesPerPixel: there
    /// is no room for more.
    void checkCounts(const FileLocation& where) const;
    const Imf::DeepFrameBuffer& frameBuffer() const { return buffer_; }

private:
    struct Channel {
        char* first; ///< of the whole field
        std::size_t stride, rowBytes;
        std::vector<char*> pixels; ///< of this row
    };

    Rect bounds_;
    int samplesPerPixel_;
    std::vector<unsigned> counts_; ///< of one row, all alike
    std::vector<Channel> channels_;
    Imf::DeepFrameBuffer buffer_;
};

/// Counts of samples in every pixel of `bounds`, row by row.
Imf::DeepFrameBuffer countBuffer(std::vector<unsigned>& counts, const Rect& bounds);

} // namespace slant
