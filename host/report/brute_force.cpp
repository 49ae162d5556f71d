#include "report/brute_force.h"

#include "reconstruct/auxiliary.h"
#include "reconstruct/film_buffer.h"
#include "reconstruct/plan.h"

#include <algorithm>

namespace slant {
namespace {

/// Samples of a pixel traced at a time, a multiple of the film's block.
constexpr int kBatch = kFilmBlock;

} // namespace

BruteForce bruteForce(const Scene& scene, const Tracer& tracer, std::uint64_t seed, Monitor& monitor,
                      bool auxiliary) {
    BruteForce result;
    FilmBuffer film(scene.film.crop, makeFilterTable(scene.filter));
    const std::span<const AuxiliarySet> sets =
        auxiliary ? auxiliarySets(true) : std::span<const AuxiliarySet>();
    std::vector<FilmBuffer> setFilms(sets.size(), film);
    LightField batch;
    batch.frame = scene.film.crop;
    batch.bounds = outputRegion(scene.film.crop, film.filter());
    monitor.beginStage("trace", batch.bounds.area() * std::uint64_t(scene.pixelSamples), "samples");
    for (int first = 0; first < scene.pixelSamples; first += kBatch) {
        batch.samplesPerPixel = std::min(kBatch, scene.pixelSamples - first);
        batch.samples.resize(batch.bounds.area() * std::size_t(batch.samplesPerPixel));
        batch.auxiliary.resize(auxiliary ? batch.samples.size() : 0);
        tracer.trace(batch.bounds, first, batch.samplesPerPixel, scene.pixelSamples, seed, batch.samples,
                     batch.auxiliary, monitor);
        result.defects.add(sanitize(batch));
        film.accumulate(denseFromInput(batch, batch.bounds), film.frame().y0, film.frame().y1);
        for (std::size_t i = 0; i < sets.size(); ++i) {
            takeValues(batch, sets[i]);
            setFilms[i].accumulate(denseFromInput(batch, batch.bounds), film.frame().y0, film.frame().y1);
        }
    }
    monitor.endStage();
    result.image = film.toImage(result.emptyPixels);
    for (std::size_t i = 0; i < sets.size(); ++i)
        addChannels(result.image, sets[i], setFilms[i].toImage(result.emptyPixels));
    return result;
}

} // namespace slant
