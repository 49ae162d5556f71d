#include "compute/vulkan_engine.h"

namespace slant {

VulkanEngine::VulkanEngine(Device& device, const SceneSideSamples& samples)
    : device_(device), samples_(samples), commands_(device), classes_(device, TexelFormat::r32ui, 0),
      missed_(device, TexelFormat::r32ui, 0), dense_(device, TexelFormat::rgba32f, 0) {}

void VulkanEngine::bin(const BinScope& scope) {
    device_.resetPeakBytes();
    scope_ = scope;
    bins_.emplace(device_, commands_, samples_, scope);
}

void VulkanEngine::refocus(float slopeShift) {
    slopeShift_ = slopeShift;
    bins_->refocus(commands_, slopeShift);
}

void VulkanEngine::takeValues(ValuePlane plane) {
    plane_ = plane;
    shading_.reset();
    if (bins_) bins_->takeValues(commands_, plane);
}

void VulkanEngine::filterShading(const ShadingPlan& plan) {
    shading_ = plan;
    bins_->filterShading(commands_, plan);
}

void VulkanEngine::begin(PictureSetup setup) {
    setup_ = std::move(setup);
    cpuBegun_ = false;
    device_.resetPeakBytes();
    film_.emplace(device_, setup_.frame, setup_.filter);
    picture_.reset();
    if (bins_)
        picture_.emplace(
            BinPicture{ListPasses(device_, setup_.pattern, lensMap(), bins_->bins()),
                       OutputPasses(device_, setup_.pattern, lensMap(), setup_.search),
                       MapPasses(device_, setup_.pattern, lensMap(), setup_.distortion, bins_->bins())});
}

void VulkanEngine::beginWindow(const WindowSearch& search) {
    windowSearch_ = search;
    cpu().beginWindow(search);
    window_.emplace(device_, cpu().windowSamples(), search, lensMap(), setup_.pattern);
}

CpuEngine& VulkanEngine::cpu() {
    if (!cpu_) {
        cpu_.emplace(samples_);
        if (bins_) cpu_->bin(scope_);
    }
    if (!cpuBegun_) {
        if (bins_) cpu_->refocus(slopeShift_);
        cpu_->takeValues(plane_);
        if (shading_) cpu_->filterShading(*shading_);
        cpu_->begin(setup_);
        cpuBegun_ = true;
    }
    return *cpu_;
}

void VulkanEngine::makeMap(const MapLayout& layout) {
    picture_->map.makeMap(commands_, bins_->bins(), layout,
                          [&](ivec2 texel) { return cpu().mapTexel(layout, texel); });
}

OutputPush VulkanEngine::pushOf(const Chunk& chunk) const {
    OutputPush push{};
    push.grid = bins_->bins().grid;
    push.outputs = chunk.layout;
    push.lensCells = setup_.pattern.lensCells;
    push.lensScale = setup_.pattern.lensScale;
    push.firstGroup = uint(chunk.firstGroup);
    push.groupCount = uint(chunk.groupCount);
    push.firstOutput = chunk.firstOutput;
    push.brickTotal = bins_->bins().brickTotal;
    push.groupBits = setup_.pattern.groupBits;
    push.takenBits = setup_.pattern.sparseBits;
    return push;
}

void VulkanEngine::reserveDense(std::uint64_t texels) {
    denseTexels_ = texels;
    if (dense_.texels() < texels) dense_ = Buffer(device_, TexelFormat::rgba32f, texels);
}

void VulkanEngine::makeLists(const Chunk& chunk) {
    const DeviceBins& bins = bins_->bins();
    lists_.emplace(picture_->lists.run(commands_, bins, pushOf(chunk), 2 * bins.grid.radiusPx));
    missed_ = Buffer(device_, TexelFormat::r32ui, 2 * (lists_->start.texels() - 1));
    reserveDense(chunk.outputs());
    commands_.fill(missed_, ~0u); // unless a map serves some of them
}

ListClasses VulkanEngine::lookUpMap(const Chunk& chunk, Monitor&) {
    ListClasses classes(lists_->start.texels() - 1);
    classes_ = Buffer(device_, TexelFormat::r32ui, classes.codes.size());
    if (setup_.observed) commands_.fill(dense_, 0); // planes that nothing reads
    picture_->map.record(commands_, picture_->lists, *lists_, picture_->outputs.pattern(), pushOf(chunk),
                         classes_, missed_, dense_);
    commands_.run();
    classes_.download(classes.codes);
    missed_.download(classes.missed);
    return classes;
}

SearchCounts VulkanEngine::search(const Chunk& chunk, const ListWork& work, Monitor& monitor) {
    OutputPasses::Result result = picture_->outputs.run(commands_, picture_->lists, bins_->bins(), *lists_,
                                                        work, missed_, pushOf(chunk), dense_);
    if (!result.overflowed.empty())
        takeFromCpu(cpu().redo(chunk, result.overflowed, result.counts), result.overflowed);
    monitor.advance(chunk.outputs());
    return result.counts;
}

SearchCounts VulkanEngine::lookThroughWindows(const Chunk& chunk, Monitor& monitor) {
    reserveDense(chunk.outputs());
    WindowPass::Result result =
        window_->run(commands_, chunk, windowSteps(samples_.field(), windowSearch_), dense_);
    if (!result.overflowed.empty())
        takeFromCpu(cpu().redoWindows(chunk, result.overflowed, result.counts), result.overflowed);
    monitor.advance(chunk.outputs());
    return result.counts;
}

void VulkanEngine::takeFromCpu(const std::vector<vec4>& dense, std::span<const uint> indices) {
    if (indices.size() == dense.size()) return dense_.upload(dense);
    for (const uint index : indices) dense_.upload(std::span(&dense[index], 1), index);
}

std::vector<vec3> VulkanEngine::binnedValues() const {
    const DeviceBins& bins = bins_->bins();
    std::vector<uint> samples(bins.grid.sampleCount);
    std::vector<vec4> values(bins.grid.sampleCount);
    bins.samples.download(samples);
    bins.values.download(values);
    return valuesOfSamples(samples, values, samples_.field().samples.size());
}

void VulkanEngine::takeInput(const Band& band) {
    const DenseSamples input = bins_ ? denseFromInput(samples_.field(), binnedValues(), band.region)
                                     : denseFromInput(samples_.field(), plane_, band.region);
    reserveDense(input.samples.size());
    dense_.upload(input.samples);
}

void VulkanEngine::addToFilm(const Band& band, int planes, int groupSize) {
    film_->accumulate(commands_, dense_, band, planes, groupSize);
}

std::vector<vec4> VulkanEngine::film() const {
    return film_->sums();
}

std::vector<uint> VulkanEngine::words(Intermediate intermediate) const {
    const auto wordsOf = [](const Buffer& buffer, std::uint64_t texels) {
        std::vector<uint> words(texels * texelBytes(buffer.format()) / sizeof(uint));
        buffer.download(words);
        return words;
    };
    const auto all = [&](const Buffer& buffer) { return wordsOf(buffer, buffer.texels()); };
    const auto bits = [](const auto& values) {
        static_assert(sizeof(values[0]) % sizeof(uint) == 0);
        const auto* words = reinterpret_cast<const uint*>(values.data());
        return std::vector<uint>(words, words + values.size() * sizeof(values[0]) / sizeof(uint));
    };
    switch (intermediate) {
    case Intermediate::bricks:
        return all(bins_->bins().bricks);
    case Intermediate::cells:
        return all(bins_->bins().cellStart);
    case Intermediate::positions:
        return all(bins_->bins().positions);
    case Intermediate::values:
        return all(bins_->bins().values);
    case Intermediate::motions:
        return all(bins_->bins().motions);
    case Intermediate::brickMotions:
        return all(bins_->bins().brickMotions);
    case Intermediate::layerMap:
        return all(picture_->map.texels());
    case Intermediate::layerMapMotions:
        return all(picture_->map.motions());
    case Intermediate::lensBounds:
        return bits(picture_->lists.lensTiles().bounds);
    case Intermediate::listStart:
        return all(lists_->start);
    case Intermediate::listBricks:
        return wordsOf(lists_->ids, all(lists_->start).back());
    case Intermediate::listClasses:
        return all(classes_);
    case Intermediate::missedPixels:
        return all(missed_);
    case Intermediate::windowPositions:
        return all(window_->positions());
    case Intermediate::windowValues:
        return all(window_->values());
    case Intermediate::windowMotions:
        return all(window_->motions());
    case Intermediate::dense:
        return wordsOf(dense_, denseTexels_);
    case Intermediate::film:
        return bits(film_->sums());
    }
    return {};
}

void VulkanEngine::addPassTimes(ReconstructReport& report) {
    for (const PassTime& time : commands_.takePassTimes()) {
        StageStats& stage = report.stage("pass " + time.name, "dispatches");
        stage.deviceSeconds = time.seconds;
        stage.items = time.dispatches;
    }
}

} // namespace slant
