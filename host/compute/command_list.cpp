#include "compute/command_list.h"

#include "compute/vulkan.h"

#include <algorithm>
#include <utility>

namespace slant {
namespace {

using Access = vk::AccessFlagBits;
using Stage = vk::PipelineStageFlagBits;

/// Descriptor sets for one run of a list: pools are added as they fill up and emptied together.
class DescriptorPools {
public:
    explicit DescriptorPools(const Device::Impl& device) : device_(device) {}

    vk::DescriptorSet allocate(const vk::DescriptorSetLayout& layout, std::size_t bindings) {
        if (current_ < pools_.size() && (sets_ == kSets || descriptors_ + bindings > kDescriptors)) {
            ++current_;
            sets_ = descriptors_ = 0;
        }
        if (current_ == pools_.size()) addPool();
        ++sets_;
        descriptors_ += bindings;
        const vk::DescriptorSetAllocateInfo info(*pools_[current_], layout);
        return (*device_.device).allocateDescriptorSets(info, *device_.device.getDispatcher()).front();
    }

    void reset() {
        for (const auto& pool : pools_) pool.reset();
        current_ = sets_ = descriptors_ = 0;
    }

private:
    static constexpr std::uint32_t kSets = 256, kDescriptors = 2048;

    void addPool() {
        const vk::DescriptorPoolSize sizes[] = {{vk::DescriptorType::eUniformTexelBuffer, kDescriptors},
                                                {vk::DescriptorType::eStorageTexelBuffer, kDescriptors}};
        pools_.emplace_back(device_.device, vk::DescriptorPoolCreateInfo({}, kSets, sizes));
    }

    const Device::Impl& device_;
    std::vector<vk::raii::DescriptorPool> pools_;
    std::size_t current_ = 0, sets_ = 0, descriptors_ = 0;
};

/// A row of timestamps: the first at the start of a run, one more after each command.
class Timestamps {
public:
    explicit Timestamps(const Device::Impl& device) : device_(device) {}

    void mark(const vk::raii::CommandBuffer& commands) {
        if (device_.timestampBits == 0) return;
        const std::uint32_t slot = marks_ % kQueries;
        if (marks_ / kQueries == pools_.size())
            pools_.emplace_back(device_.device,
                                vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, kQueries));
        const auto pool = *pools_[marks_++ / kQueries];
        if (slot == 0) commands.resetQueryPool(pool, 0, kQueries);
        commands.writeTimestamp(Stage::eBottomOfPipe, pool, slot);
    }

    /// Seconds between each two neighbouring marks; forgets them.
    std::vector<double> intervals() {
        const std::uint64_t mask = device_.timestampBits >= 64 ? ~0ull : (1ull << device_.timestampBits) - 1;
        const double tick = device_.info.limits.timestampNanoseconds * 1e-9;
        std::vector<double> result;
        std::uint64_t previous = 0;
        for (std::uint32_t first = 0; first < marks_; first += kQueries) {
            const std::uint32_t count = std::min(kQueries, marks_ - first);
            const auto [status, ticks] = pools_[first / kQueries].getResults<std::uint64_t>(
                0, count, count * sizeof(std::uint64_t), sizeof(std::uint64_t),
                vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
            for (std::uint32_t i = 0; i < count; ++i) {
                if (first + i > 0) result.push_back(double((ticks[i] - previous) & mask) * tick);
                previous = ticks[i];
            }
        }
        marks_ = 0;
        return result;
    }

private:
    static constexpr std::uint32_t kQueries = 256;

    const Device::Impl& device_;
    std::vector<vk::raii::QueryPool> pools_;
    std::uint32_t marks_ = 0;
};

void requireFit(const Pass& pass, CommandList::Bindings buffers, std::size_t pushBytes, Grid grid) {
    const ShaderInterface& interface = pass.interface();
    const DeviceLimits& limits = pass.impl().limits;
    const auto fail = [&](const std::string& why) {
        throw Error(ErrorCode::usage, fmt::format("dispatch of '{}': {}", pass.name(), why));
    };
    if (buffers.size() != interface.bindings.size())
        fail(fmt::format("{} buffers, the shader has {}", buffers.size(), interface.bindings.size()));
    if (pushBytes != interface.pushBytes)
        fail(fmt::format("{} bytes of push constants, the shader has {}", pushBytes, interface.pushBytes));
    if (grid.x > limits.workgroupsX || grid.y > limits.workgroupsY || grid.z > limits.workgroupsZ)
        fail(fmt::format("{} x {} x {} workgroups, the device takes {} x {} x {}", grid.x, grid.y, grid.z,
                         limits.workgroupsX, limits.workgroupsY, limits.workgroupsZ));
    auto buffer = buffers.begin();
    for (const ShaderBinding& binding : interface.bindings) {
        const TexelFormat format = (buffer++)->get().format();
        const bool fits =
            binding.format ? *binding.format == format : binding.integers == holdsIntegers(format);
        if (!fits) fail(fmt::format("buffer '{}' has the wrong format {}", binding.name, formatName(format)));
    }
}

} // namespace

struct CommandList::Impl {
    explicit Impl(Device& owner)
        : device(owner), vulkan(owner.impl()), descriptors(vulkan), timestamps(vulkan) {
        checked("making a command list", [&] {
            pool = vk::raii::CommandPool(
                vulkan.device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                                         vulkan.queueFamily));
            const vk::CommandBufferAllocateInfo info(*pool, vk::CommandBufferLevel::ePrimary, 1);
            commands = std::move(vk::raii::CommandBuffers(vulkan.device, info).front());
            fence = vk::raii::Fence(vulkan.device, vk::FenceCreateInfo());
        });
    }

    /// Begins recording with the first command.
    void begin() {
        if (submitted) throw Error(ErrorCode::usage, "recording into a command list that is running");
        if (recording) return;
        commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
        recording = true;
        barrier(Stage::eComputeShader | Stage::eTransfer,
                Access::eShaderRead | Access::eShaderWrite | Access::eTransferRead | Access::eTransferWrite);
        timestamps.mark(commands);
    }

    /// What follows a command: later ones see its writes.
    void end(std::string_view name) {
        barrier(Stage::eComputeShader | Stage::eTransfer,
                Access::eShaderRead | Access::eShaderWrite | Access::eTransferRead | Access::eTransferWrite);
        timestamps.mark(commands);
        const auto found = std::ranges::find(times, name, &PassTime::name);
        recorded.push_back(std::size_t(found - times.begin()));
        if (found == times.end()) times.push_back({std::string(name), 0, 0});
    }

    void barrier(vk::PipelineStageFlags stages, vk::AccessFlags access) {
        const vk::MemoryBarrier memory(Access::eShaderWrite | Access::eTransferWrite, access);
        commands.pipelineBarrier(Stage::eComputeShader | Stage::eTransfer, stages, {}, memory, {}, {});
    }

    vk::DescriptorSet describe(const Pass& pass, Bindings buffers) {
        const vk::DescriptorSet set = descriptors.allocate(*pass.impl().setLayout, buffers.size());
        std::vector<vk::BufferView> views;
        for (const Buffer& buffer : buffers) views.push_back(*buffer.impl().view);
        std::vector<vk::WriteDescriptorSet> writes;
        for (const ShaderBinding& b : pass.interface().bindings)
            writes.emplace_back(set, b.binding, 0, 1, descriptorType(b), nullptr, nullptr, &views[b.binding]);
        vulkan.device.updateDescriptorSets(writes, {});
        return set;
    }

    Device& device;
    const Device::Impl& vulkan;
    vk::raii::CommandPool pool = nullptr;
    vk::raii::CommandBuffer commands = nullptr;
    vk::raii::Fence fence = nullptr;
    DescriptorPools descriptors;
    Timestamps timestamps;
    bool recording = false;
    bool submitted = false;
    std::vector<std::size_t> recorded; ///< index into `times` of each command
    std::vector<PassTime> times;
};

CommandList::CommandList(Device& device) : impl_(std::make_unique<Impl>(device)) {}

CommandList::~CommandList() {
    try {
        if (impl_->submitted) impl_->vulkan.wait(impl_->fence, "ending a command list");
    } catch (const Error&) { // a lost device: nothing runs any more
    }
}

void CommandList::dispatchBytes(const Pass& pass, Bindings buffers, std::span<const std::byte> push,
                                Grid grid) {
    requireFit(pass, buffers, push.size(), grid);
    if (grid.x == 0 || grid.y == 0 || grid.z == 0) return;
    checked("recording a dispatch", [&] {
        impl_->begin();
        const auto& commands = impl_->commands;
        const auto layout = *pass.impl().layout;
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pass.impl().pipeline);
        if (buffers.size() > 0)
            commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, layout, 0,
                                        impl_->describe(pass, buffers), {});
        commands.pushConstants<std::byte>(layout, vk::ShaderStageFlagBits::eCompute, 0,
                                          {std::uint32_t(push.size()), push.data()});
        commands.dispatch(grid.x, grid.y, grid.z);
        impl_->end(pass.name());
    });
}

void CommandList::fill(const Buffer& buffer, std::uint32_t word) {
    checked("recording a fill", [&] {
        impl_->begin();
        impl_->commands.fillBuffer(*buffer.impl().buffer, 0, VK_WHOLE_SIZE, word);
        impl_->end("fill");
    });
}

void CommandList::submit() {
    checked("submitting", [&] {
        impl_->begin();
        impl_->barrier(Stage::eHost, Access::eHostRead);
        impl_->commands.end();
        impl_->recording = false;
        impl_->vulkan.queue.submit(vk::SubmitInfo({}, {}, *impl_->commands), *impl_->fence);
        impl_->submitted = true;
    });
}

void CommandList::wait() {
    if (!impl_->submitted) throw Error(ErrorCode::usage, "waiting for a command list that was not submitted");
    impl_->vulkan.wait(impl_->fence, "running passes");
    checked("reading timestamps", [&] {
        const auto seconds = impl_->timestamps.intervals();
        for (std::size_t i = 0; i < impl_->recorded.size(); ++i) {
            PassTime& time = impl_->times[impl_->recorded[i]];
            time.seconds += seconds.empty() ? 0 : seconds[i];
            ++time.dispatches;
        }
        impl_->recorded.clear();
        impl_->descriptors.reset();
        impl_->vulkan.device.resetFences(*impl_->fence);
        impl_->commands.reset();
        impl_->submitted = false;
    });
    impl_->device.checkValidation();
}

std::vector<PassTime> CommandList::takePassTimes() {
    return std::exchange(impl_->times, {});
}

} // namespace slant
