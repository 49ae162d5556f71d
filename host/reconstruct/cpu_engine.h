// The stages of a reconstruction on the CPU: the plain version that the compute path is compared with.
#pragma once
#include "reconstruct/chunk_outputs.h"
#include "reconstruct/engine.h"
#include "reconstruct/field_bins.h"
#include "reconstruct/window_outputs.h"

#include <optional>

namespace slant {

class CpuEngine final : public Engine {
public:
    /// `samples` must outlive it.
    explicit CpuEngine(const SceneSideSamples& samples) : samples_(samples) {}

    void bin(const BinScope& scope) override { bins_.emplace(samples_, scope); }
    void refocus(float slopeShift) override { bins_->refocus(slopeShift); }
    void takeValues(ValuePlane plane) override;
    void filterShading(const ShadingPlan& plan) override { bins_->filterShading(plan); }
    const GridLayout& grid() const override { return bins_->bins().grid; }
    const MotionGrid& motion() const override { return bins_->bins().motion; }
    void begin(PictureSetup setup) override;
    void beginWindow(const WindowSearch& search) override;
    void makeMap(const MapLayout& layout) override;
    void makeLists(const Chunk& chunk) override;
    ListClasses lookUpMap(const Chunk& chunk, Monitor& monitor) override;
    SearchCounts search(const Chunk& chunk, const ListWork& work, Monitor& monitor) override;
    SearchCounts lookThroughWindows(const Chunk& chunk, Monitor& monitor) override;
    void takeInput(const Band& band) override;
    void addToFilm(const Band& band, int planes, int groupSize) override;
    std::vector<vec4> film() const override { return film_->sums(); }
    std::vector<uint> words(Intermediate intermediate) const override;
    std::uint64_t peakBytes() const override { return peakBytes_; }

    // Work that the compute path leaves to the CPU because its loops are too long for a shader.

    /// One texel of level 0 of a layer map.
    MapTexel mapTexel(const MapLayout& layout, ivec2 texel) const;
    /// Some dense samples of a chunk, by index; the others stay undefined.
    const std::vector<vec4>& redo(const Chunk& chunk, std::span<const uint> indices, SearchCounts& counts);
    const WindowSamples& windowSamples() const { return windowSamples_; }
    const std::vector<vec4>& redoWindows(const Chunk& chunk, std::span<const uint> indices,
                                         SearchCounts& counts);

private:
    const LensMap& lensMap() const { return samples_.field().lensMap; }
    const DenseSamples& dense() const;
    void noteBytes(std::uint64_t bytes) { peakBytes_ = std::max(peakBytes_, bytes); }

    const SceneSideSamples& samples_;
    std::optional<FieldBins> bins_;
    ValuePlane plane_ = ValuePlane::radiance; ///< for windows and input samples
    PictureSetup setup_;
    BrickOrders orders_;
    std::optional<FilmBuffer> film_;
    LayerMap map_;
    ListClasses classes_{0};
    WindowSearch windowSearch_{};
    WindowSamples windowSamples_;
    // Dense samples of one of them.
    std::optional<ChunkOutputs> outputs_;
    std::optional<WindowOutputs> windows_;
    DenseSamples input_;
    std::uint64_t peakBytes_ = 0;
};

} // namespace slant
