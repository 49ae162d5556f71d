// Stage "pixel_filter" on the device: the film, and the passes that add dense planes to it.
#pragma once
#include "compute/command_list.h"
#include "reconstruct/film_buffer.h"
#include "reconstruct/plan.h"

namespace slant {

class FilmPass {
public:
    /// A film with the sums that `film` has.
    FilmPass(Device& device, const FilmBuffer& film);

    /// As FilmBuffer::accumulate. Runs on `commands`, which must be empty, and leaves it empty.
    void accumulate(CommandList& commands, const Buffer& dense, const Band& band, int planes, int groupSize);

    void download(FilmBuffer& film) const;

private:
    Device& device_;
    FilterTable table_;
    Rect frame_;
    Pass spread_, gather_;
    Buffer weights_, sums_;
};

} // namespace slant
