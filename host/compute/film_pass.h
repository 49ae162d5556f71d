// Stage "pixel_filter" on the device: the film, and the passes that add dense planes to it.
#pragma once
#include "compute/command_list.h"
#include "reconstruct/film_buffer.h"
#include "reconstruct/plan.h"

namespace slant {

class FilmPass {
public:
    /// An empty film.
    FilmPass(Device& device, const Rect& frame, FilterTable filter);

    /// Like FilmBuffer::accumulate. Runs on `commands`, which must be empty, and leaves it empty.
    void accumulate(CommandList& commands, const Buffer& dense, const Band& band, int planes, int groupSize);

    /// See Engine::film.
    std::vector<vec4> sums() const;

private:
    Device& device_;
    FilterTable table_;
    Rect frame_;
    Pass spread_, gather_;
    Buffer weights_, sums_;
};

} // namespace slant
