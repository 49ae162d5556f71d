// The stages of a reconstruction in compute shaders: the same words as CpuEngine.
#pragma once
#include "compute/device_field_bins.h"
#include "compute/film_pass.h"
#include "compute/map_passes.h"
#include "compute/output_passes.h"
#include "compute/window_pass.h"
#include "reconstruct/cpu_engine.h"

#include <optional>

namespace slant {

class VulkanEngine final : public Engine {
public:
    /// Both must outlive it.
    VulkanEngine(Device& device, const SceneSideSamples& samples);

    std::uint64_t maxDenseSamples() const override { return device_.limits().texelBufferElements; }
    void bin(const BinScope& scope) override;
    void refocus(float slopeShift) override;
    void takeValues(ValuePlane plane) override;
    void filterShading(const ShadingPlan& plan) override;
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
    std::vector<vec4> film() const override;
    std::vector<uint> words(Intermediate intermediate) const override;
    std::uint64_t peakBytes() const override { return device_.peakBytes(); }
    void addPassTimes(ReconstructReport& report) override;

private:
    /// State made anew for each picture that searches the bins.
    struct BinPicture {
        ListPasses lists;
        OutputPasses outputs;
        MapPasses map;
    };

    const LensMap& lensMap() const { return samples_.field().lensMap; }
    OutputPush pushOf(const Chunk& chunk) const;
    void reserveDense(std::uint64_t texels);
    /// The CPU engine at the same point of the same picture, for loops too long for a shader.
    CpuEngine& cpu();
    /// Of the binned samples, in the order of the field.
    std::vector<vec3> binnedValues() const;
    void takeFromCpu(const std::vector<vec4>& dense, std::span<const uint> indices);

    Device& device_;
    const SceneSideSamples& samples_;
    CommandList commands_; ///< empty between stages
    std::optional<DeviceFieldBins> bins_;
    BinScope scope_;
    float slopeShift_ = 0;
    ValuePlane plane_ = ValuePlane::radiance;
    std::optional<ShadingPlan> shading_; ///< of the values, if theirs is filtered
    std::optional<CpuEngine> cpu_;
    bool cpuBegun_ = false;

    PictureSetup setup_;
    std::optional<FilmPass> film_;
    std::optional<BinPicture> picture_;
    std::optional<DeviceLists> lists_;
    Buffer classes_, missed_; ///< of the lists
    std::optional<WindowPass> window_;
    WindowSearch windowSearch_{};
    Buffer dense_;
    std::uint64_t denseTexels_ = 0; ///< of them, those in use
};

} // namespace slant
