#include "reconstruct/cpu_engine.h"

#include <cstring>

namespace slant {

void CpuEngine::takeValues(ValuePlane plane) {
    plane_ = plane;
    if (bins_) bins_->takeValues(plane);
}

void CpuEngine::begin(PictureSetup setup) {
    setup_ = std::move(setup);
    if (bins_) orders_ = BrickOrders(motion(), bins_->bins().brickRanks, setup_.pattern.slotTimes());
    film_.emplace(setup_.frame, setup_.filter);
    peakBytes_ = 0;
}

void CpuEngine::beginWindow(const WindowSearch& search) {
    windowSearch_ = search;
    windowSamples_ = slant::windowSamples(samples_, plane_);
}

void CpuEngine::makeMap(const MapLayout& layout) {
    map_ = makeLayerMap(bins_->bins(), layout, setup_.distortion);
    noteBytes(map_.texels.size() * sizeof(glm::uvec4));
}

void CpuEngine::makeLists(const Chunk& chunk) {
    outputs_.emplace(bins_->bins(), orders_, lensMap(), setup_.pattern, setup_.search, chunk);
    outputs_->makeLists();
    noteBytes(outputs_->dense.samples.size() * sizeof(vec4));
}

ListClasses CpuEngine::lookUpMap(const Chunk&, Monitor& monitor) {
    return classes_ = outputs_->lookUpMap(map_, monitor);
}

SearchCounts CpuEngine::search(const Chunk&, const ListWork& work, Monitor& monitor) {
    return outputs_->search(work, monitor);
}

SearchCounts CpuEngine::lookThroughWindows(const Chunk& chunk, Monitor& monitor) {
    windows_.emplace(windowSamples_, windowSearch_, lensMap(), setup_.pattern, chunk);
    noteBytes(windows_->dense.samples.size() * sizeof(vec4));
    return windows_->look(monitor);
}

void CpuEngine::takeInput(const Band& band) {
    const LightField& field = samples_.field();
    if (bins_)
        input_ = denseFromInput(
            field, valuesOfSamples(bins_->bins().samples, bins_->bins().values, field.samples.size()),
            band.region);
    else
        input_ = denseFromInput(field, plane_, band.region);
    noteBytes(input_.samples.size() * sizeof(vec4));
}

const DenseSamples& CpuEngine::dense() const {
    return outputs_ ? outputs_->dense : windows_ ? windows_->dense : input_;
}

void CpuEngine::addToFilm(const Band& band, int, int) {
    film_->accumulate(dense(), band.y0, band.y1);
}

std::vector<uint> CpuEngine::words(Intermediate intermediate) const {
    const auto wordsOf = [](const auto& values) {
        std::vector<uint> words(values.size() * sizeof(values[0]) / sizeof(uint));
        if (!words.empty()) std::memcpy(words.data(), values.data(), words.size() * sizeof(uint));
        return words;
    };
    switch (intermediate) {
    case Intermediate::bricks:
        return wordsOf(bins_->bins().bricks);
    case Intermediate::cells:
        return wordsOf(bins_->bins().cellStart);
    case Intermediate::positions:
        return wordsOf(bins_->bins().positions);
    case Intermediate::values:
        return wordsOf(bins_->bins().values);
    case Intermediate::motions:
        return wordsOf(bins_->bins().motions);
    case Intermediate::brickMotions:
        return wordsOf(bins_->bins().brickMotions);
    case Intermediate::layerMap:
        return wordsOf(map_.texels);
    case Intermediate::layerMapMotions:
        return wordsOf(map_.motions);
    case Intermediate::lensBounds:
        return wordsOf(outputs_->lensTiles.bounds);
    case Intermediate::listStart:
        return wordsOf(outputs_->lists.start);
    case Intermediate::listBricks:
        return wordsOf(outputs_->lists.bricks);
    case Intermediate::listClasses:
        return wordsOf(classes_.codes);
    case Intermediate::missedPixels:
        return wordsOf(classes_.missed);
    case Intermediate::windowPositions:
        return wordsOf(windowSamples_.positions);
    case Intermediate::windowValues:
        return wordsOf(windowSamples_.values);
    case Intermediate::windowMotions:
        return wordsOf(windowSamples_.motions);
    case Intermediate::dense:
        return wordsOf(dense().samples);
    case Intermediate::film:
        return wordsOf(film_->sums());
    }
    return {};
}

MapTexel CpuEngine::mapTexel(const MapLayout& layout, ivec2 texel) const {
    const Bins& bins = bins_->bins();
    std::vector<uint> bricks(bins.bricks.size());
    for (uint i = 0; i < bricks.size(); ++i) bricks[i] = i;
    return resolveTexel({bins, bricks}, layout, setup_.distortion.pinhole(), texel);
}

const std::vector<vec4>& CpuEngine::redo(const Chunk& chunk, std::span<const uint> indices,
                                         SearchCounts& counts) {
    makeLists(chunk);
    counts.add(outputs_->redo(indices));
    return outputs_->dense.samples;
}

const std::vector<vec4>& CpuEngine::redoWindows(const Chunk& chunk, std::span<const uint> indices,
                                                SearchCounts& counts) {
    windows_.emplace(windowSamples_, windowSearch_, lensMap(), setup_.pattern, chunk);
    counts.add(windows_->redo(indices));
    return windows_->dense.samples;
}

} // namespace slant
