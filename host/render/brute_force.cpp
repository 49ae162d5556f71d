#include "render/brute_force.h"

#include "reconstruct/film_buffer.h"
#include "reconstruct/plan.h"
#include "render/auxiliary.h"

#include <algorithm>

namespace slant {
namespace {

/// Samples per pixel traced at a time, a multiple of the film's block.
constexpr int kBatch = kFilmBlock;

} // namespace

BruteForce bruteForce(const Scene& scene, const Tracer& tracer, std::uint64_t seed, Monitor& monitor,
                      bool auxiliary) {
    BruteForce result;
    const bool withMotion = auxiliary && tracer.moves();
    FilmBuffer film(scene.film.crop, makeFilterTable(scene.filter));
    const std::vector<AuxiliarySet> sets =
        auxiliary ? auxiliarySets(true, withMotion) : std::vector<AuxiliarySet>();
    std::vector<FilmBuffer> setFilms(sets.size(), film);
    LightField batch;
    batch.frame = scene.film.crop;
    batch.bounds = outputRegion(scene.film.crop, film.filter());
    monitor.beginStage("trace", batch.bounds.area() * std::uint64_t(scene.pixelSamples), "samples");
    for (int first = 0; first < scene.pixelSamples; first += kBatch) {
        batch.samplesPerPixel = std::min(kBatch, scene.pixelSamples - first);
        batch.resize(batch.bounds.area() * std::size_t(batch.samplesPerPixel),
                     {.albedo = auxiliary, .motion = withMotion});
        tracer.trace(batch.bounds, {first, batch.samplesPerPixel}, scene.pixelSamples, seed, spansOf(batch),
                     monitor);
        result.defects.add(sanitize(batch));
        const auto add = [&](FilmBuffer& to, ValuePlane plane) {
            to.accumulate(denseFromInput(batch, plane, batch.bounds), to.frame().y0, to.frame().y1);
        };
        add(film, ValuePlane::radiance);
        for (std::size_t i = 0; i < sets.size(); ++i) add(setFilms[i], sets[i].plane);
    }
    monitor.endStage();
    const auto imageOf = [&](const FilmBuffer& each) {
        return filmImage(each.frame(), each.sums(), result.emptyPixels);
    };
    result.image = imageOf(film);
    for (std::size_t i = 0; i < sets.size(); ++i) addChannels(result.image, sets[i], imageOf(setFilms[i]));
    return result;
}

} // namespace slant
