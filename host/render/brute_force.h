// The reference: every pixel from its own many samples, without reconstruction.
#pragma once
#include "base/monitor.h"
#include "image/image.h"
#include "lightfield/lightfield.h"
#include "scene/scene.h"
#include "trace/tracer.h"

#include <cstdint>

namespace slant {

struct BruteForce {
    Image image;                   ///< of scene.film.crop, channels R, G, B (and auxiliary ones)
    FieldDefects defects;          ///< bad samples, treated as in any field
    std::uint64_t emptyPixels = 0; ///< black because no sample reached them
};

/// The same pattern and pixel filter as method `box` with scene.pixelSamples samples, but any number of them
/// in bounded memory. One stage "trace" of the monitor.
/// With `auxiliary` the image has the channels of render/auxiliary.h, too; those of motion if anything moves.
BruteForce bruteForce(const Scene& scene, const Tracer& tracer, std::uint64_t seed, Monitor& monitor,
                      bool auxiliary = false);

} // namespace slant
