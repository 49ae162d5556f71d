#include "compute/film_pass.h"

#include <algorithm>
#include <array>

namespace slant {

namespace {

/// Texels for what the samples of a pixel contribute to the pixels around it; they limit the rows per
/// dispatch.
constexpr std::uint64_t kSpreadTexels = 1 << 21;

std::array<std::uint32_t, 2> reachOf(const FilterTable& table) {
    return {std::uint32_t(table.reach.x), std::uint32_t(table.reach.y)};
}

} // namespace

FilmPass::FilmPass(Device& device, const Rect& frame, FilterTable filter)
    : device_(device), table_(std::move(filter)), frame_(frame),
      spread_(device, "film_spread", reachOf(table_)), gather_(device, "film_gather", reachOf(table_)),
      weights_(device, TexelFormat::r32f, table_.weights.size()),
      sums_(device, TexelFormat::rgba32f, frame.area()) {
    weights_.upload(std::span<const float>(table_.weights));
    sums_.upload(std::vector<vec4>(frame.area(), vec4(0)));
}

void FilmPass::accumulate(CommandList& commands, const Buffer& dense, const Band& band, int planes,
                          int groupSize) {
    const ivec2 reach = table_.reach;
    const std::uint64_t taps = std::uint64_t(2 * reach.x + 1) * std::uint64_t(2 * reach.y + 1);
    const std::uint64_t rowTexels = std::uint64_t(band.region.width()) * taps;
    const int rows = std::clamp(int(kSpreadTexels / rowTexels) - 2 * reach.y, 1, band.y1 - band.y0);
    const Buffer spread(device_, TexelFormat::rgba32f, std::uint64_t(rows + 2 * reach.y) * rowTexels);
    FilterPush push{};
    push.regionSize = ivec2(band.region.width(), band.region.height());
    push.tableLength = table_.length;
    push.filmSize = ivec2(frame_.width(), frame_.height());
    push.groupSize = groupSize;
    for (int y = band.y0; y < band.y1; y += rows) {
        push.firstRow = y - frame_.y0;
        push.rowCount = std::min(rows, band.y1 - y);
        push.regionRow = y - band.y0;
        for (int first = 0; first < planes; first += kFilmBlock) {
            push.firstPlane = first;
            push.planeCount = std::min(kFilmBlock, planes - first);
            commands.dispatch(spread_, {dense, weights_, spread}, push,
                              spread_.gridOver(std::uint32_t(push.regionSize.x),
                                               std::uint32_t(push.rowCount + 2 * reach.y)));
            commands.dispatch(gather_, {spread, sums_}, push,
                              gather_.gridOver(std::uint32_t(frame_.width()), std::uint32_t(push.rowCount)));
        }
    }
    commands.run();
}

std::vector<vec4> FilmPass::sums() const {
    std::vector<vec4> sums(sums_.texels());
    sums_.download(sums);
    return sums;
}

} // namespace slant
