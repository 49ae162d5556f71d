#include "compute/pass.h"

#include "compute/vulkan.h"

#include <algorithm>

namespace slant {
namespace {

vk::raii::DescriptorSetLayout makeSetLayout(const Device::Impl& device, const ShaderInterface& interface) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const ShaderBinding& b : interface.bindings)
        bindings.emplace_back(b.binding, descriptorType(b), 1, vk::ShaderStageFlagBits::eCompute);
    return {device.device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::PipelineLayout makeLayout(const Device::Impl& device, const ShaderInterface& interface,
                                    const vk::raii::DescriptorSetLayout& setLayout) {
    vk::PipelineLayoutCreateInfo info({}, *setLayout);
    const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, interface.pushBytes);
    if (interface.pushBytes > 0) info.setPushConstantRanges(range);
    return {device.device, info};
}

vk::raii::Pipeline makePipeline(const Device::Impl& device, const ShaderModule& module,
                                std::span<const std::uint32_t> constants,
                                const vk::raii::PipelineLayout& layout) {
    std::vector<vk::SpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < constants.size(); ++i)
        entries.emplace_back(i, std::uint32_t(i * sizeof(std::uint32_t)), sizeof(std::uint32_t));
    const vk::SpecializationInfo specialization(std::uint32_t(entries.size()), entries.data(),
                                                constants.size_bytes(), constants.data());
    const vk::raii::ShaderModule shader(
        device.device, vk::ShaderModuleCreateInfo({}, module.words.size_bytes(), module.words.data()));
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *shader, "main",
                                                  &specialization);
    return {device.device, nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout)};
}

void requireWithinLimits(const ShaderModule& module, const ShaderInterface& interface,
                         const DeviceLimits& limits) {
    const auto& local = interface.localSize;
    if (local[0] * local[1] * local[2] > limits.workgroupInvocations)
        throw Error(ErrorCode::device,
                    fmt::format("shader '{}' has workgroups of {} x {} x {}, the device takes {} "
                                "invocations",
                                module.name, local[0], local[1], local[2], limits.workgroupInvocations));
    if (interface.pushBytes > limits.pushConstantBytes)
        throw Error(ErrorCode::device,
                    fmt::format("shader '{}' has {} bytes of push constants, the device takes {}",
                                module.name, interface.pushBytes, limits.pushConstantBytes));
}

} // namespace

Pass::Impl::Impl(const Device::Impl& device, const ShaderModule& module,
                 std::span<const std::uint32_t> constants)
    : name(module.name), interface(reflect(module)), limits(device.info.limits) {
    requireWithinLimits(module, interface, limits);
    checked(fmt::format("making the pipeline of shader '{}'", name), [&] {
        setLayout = makeSetLayout(device, interface);
        layout = makeLayout(device, interface, setLayout);
        pipeline = makePipeline(device, module, constants, layout);
    });
}

Pass::Pass(Device& device, std::string_view shader, std::span<const std::uint32_t> constants)
    : impl_(std::make_unique<Impl>(device.impl(), shaderModule(shader), constants)) {
    device.checkValidation();
}

Pass::~Pass() = default;
Pass::Pass(Pass&&) noexcept = default;
Pass& Pass::operator=(Pass&&) noexcept = default;

std::string_view Pass::name() const {
    return impl_->name;
}

const ShaderInterface& Pass::interface() const {
    return impl_->interface;
}

Grid Pass::gridFor(std::uint64_t items) const {
    const std::uint64_t local = impl_->interface.localSize[0];
    const std::uint64_t groups = (items + local - 1) / local;
    const std::uint64_t x = std::min<std::uint64_t>(groups, impl_->limits.workgroupsX);
    const std::uint64_t y = x == 0 ? 0 : (groups + x - 1) / x;
    if (y > impl_->limits.workgroupsY)
        throw Error(ErrorCode::resources,
                    fmt::format("pass '{}' over {} items needs {} workgroups, the device "
                                "takes {} x {}",
                                impl_->name, items, groups, impl_->limits.workgroupsX,
                                impl_->limits.workgroupsY));
    return {std::uint32_t(x), std::uint32_t(y)};
}

Grid Pass::gridOver(std::uint32_t width, std::uint32_t height) const {
    const auto& local = impl_->interface.localSize;
    return {(width + local[0] - 1) / local[0], (height + local[1] - 1) / local[1]};
}

} // namespace slant
