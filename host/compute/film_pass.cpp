#include "compute/film_pass.h"

#include <algorithm>

namespace slant {

FilmPass::FilmPass(Device& device, const FilmBuffer& film)
    : pass_(device, "pixel_filter"), table_(film.filter()), frame_(film.frame()),
      weights_(device, TexelFormat::r32f, table_.weights.size()),
      sums_(device, TexelFormat::rgba32f, film.sums().size()) {
    weights_.upload(std::span<const float>(table_.weights));
    sums_.upload(std::span<const vec4>(film.sums()));
}

void FilmPass::accumulate(CommandList& commands, const Buffer& dense, const Band& band, int planes,
                          int groupSize) {
    FilterPush push{};
    push.regionSize = ivec2(band.region.width(), band.region.height());
    push.reach = table_.reach;
    push.tableLength = table_.length;
    push.groupSize = groupSize;
    push.filmSize = ivec2(frame_.width(), frame_.height());
    push.firstRow = band.y0 - frame_.y0;
    push.rowCount = band.y1 - band.y0;
    const int taps = 2 * (2 * table_.reach.x + 1) * (2 * table_.reach.y + 2);
    const int most = std::max(1, kMaxLoopIterations / (taps * kFilmBlock)) * kFilmBlock;
    for (int first = 0; first < planes; first += most) {
        push.firstPlane = first;
        push.planeCount = std::min(most, planes - first);
        commands.dispatch(pass_, {dense, weights_, sums_}, push,
                          pass_.gridOver(std::uint32_t(frame_.width()), std::uint32_t(push.rowCount)));
    }
    commands.run();
}

void FilmPass::download(FilmBuffer& film) const {
    sums_.download(std::span(film.sums()));
}

} // namespace slant
