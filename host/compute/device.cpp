#include "compute/vulkan.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace slant {
namespace {

constexpr std::uint32_t kApiVersion = VK_API_VERSION_1_2;

vk::raii::Context makeContext() {
    try {
        return vk::raii::Context();
    } catch (const std::runtime_error&) {
        throw Error(ErrorCode::device, "no Vulkan loader on this machine (Debian: libvulkan1)");
    }
}

bool hasLayer(const vk::raii::Context& context, std::string_view name) {
    return std::ranges::any_of(context.enumerateInstanceLayerProperties(),
                               [&](const auto& layer) { return name == layer.layerName.data(); });
}

constexpr const char* kNoDevice =
    "no Vulkan device on this machine (Debian's mesa-vulkan-drivers has one that "
    "runs on the CPU); --device cpu does without";

vk::raii::Instance createInstance(const vk::raii::Context& context, const vk::InstanceCreateInfo& info) {
    try {
        return {context, info};
    } catch (const vk::IncompatibleDriverError&) { // how the loader says that it found no driver
        throw Error(ErrorCode::device, kNoDevice);
    }
}

/// With validation into `log` where there is one.
vk::raii::Instance makeInstance(const vk::raii::Context& context, ValidationLog* log) {
    return checked("starting", [&] {
        if (context.enumerateInstanceVersion() < kApiVersion)
            throw Error(ErrorCode::device, "the Vulkan loader is older than 1.2");
        const vk::ApplicationInfo application("slant", 1, nullptr, 0, kApiVersion);
        if (!log) return createInstance(context, vk::InstanceCreateInfo({}, &application));

        if (!hasLayer(context, ValidationLog::kLayer))
            throw Error(ErrorCode::device, fmt::format("validation was asked for, but {} is not installed "
                                                       "(Debian: vulkan-validationlayers)",
                                                       ValidationLog::kLayer));
        const auto messengerInfo = log->messengerInfo();
        const auto synchronization = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
        const vk::ValidationFeaturesEXT features(synchronization, {}, &messengerInfo);
        const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
        const char* layer = ValidationLog::kLayer;
        return createInstance(context, vk::InstanceCreateInfo({}, &application, layer, extension, &features));
    });
}

std::string versionText(std::uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

std::string typeText(vk::PhysicalDeviceType type) {
    switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
        return "discrete";
    case vk::PhysicalDeviceType::eIntegratedGpu:
        return "integrated";
    case vk::PhysicalDeviceType::eVirtualGpu:
        return "virtual";
    case vk::PhysicalDeviceType::eCpu:
        return "cpu";
    default:
        return "other";
    }
}

int preference(const DeviceInfo& info) {
    constexpr std::string_view order[] = {"discrete", "integrated", "virtual", "cpu", "other"};
    return int(std::ranges::find(order, info.type) - std::begin(order)) + (info.unsuitable.empty() ? 0 : 10);
}

std::optional<std::uint32_t> computeQueueFamily(const vk::raii::PhysicalDevice& physical) {
    const auto families = physical.getQueueFamilyProperties();
    for (std::uint32_t i = 0; i < families.size(); ++i)
        if (families[i].queueFlags & vk::QueueFlagBits::eCompute) return i;
    return std::nullopt;
}

std::string whyUnsuitable(const vk::raii::PhysicalDevice& physical) {
    if (physical.getProperties().apiVersion < kApiVersion) return "older than Vulkan 1.2";
    if (!computeQueueFamily(physical)) return "no compute queue";
    using Feature = vk::FormatFeatureFlagBits;
    for (const TexelFormat format : kTexelFormats) {
        const auto features = physical.getFormatProperties(vulkanFormat(format)).bufferFeatures;
        if (!(features & Feature::eUniformTexelBuffer) || !(features & Feature::eStorageTexelBuffer))
            return fmt::format("no {} texel buffers", formatName(format));
    }
    return {};
}

DeviceLimits limitsOf(const vk::raii::PhysicalDevice& physical) {
    const auto chain =
        physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan11Properties>();
    const auto& limits = chain.get<vk::PhysicalDeviceProperties2>().properties.limits;
    const auto& core11 = chain.get<vk::PhysicalDeviceVulkan11Properties>();
    DeviceLimits result;
    result.storageBufferBytes = limits.maxStorageBufferRange;
    result.texelBufferElements = limits.maxTexelBufferElements;
    result.allocationBytes = core11.maxMemoryAllocationSize;
    for (const vk::MemoryHeap& heap : physical.getMemoryProperties().memoryHeaps)
        if (heap.flags & vk::MemoryHeapFlagBits::eDeviceLocal) result.heapBytes += heap.size;
    result.workgroupsX = limits.maxComputeWorkGroupCount[0];
    result.workgroupsY = limits.maxComputeWorkGroupCount[1];
    result.workgroupsZ = limits.maxComputeWorkGroupCount[2];
    result.workgroupInvocations = limits.maxComputeWorkGroupInvocations;
    result.pushConstantBytes = limits.maxPushConstantsSize;
    result.sharedMemoryBytes = limits.maxComputeSharedMemorySize;
    result.subgroupSize = core11.subgroupSize;
    const auto family = computeQueueFamily(physical);
    if (family && physical.getQueueFamilyProperties()[*family].timestampValidBits > 0)
        result.timestampNanoseconds = double(limits.timestampPeriod);
    return result;
}

struct Candidate {
    vk::raii::PhysicalDevice physical;
    DeviceInfo info;
};

/// In the order of preference.
std::vector<Candidate> candidates(const vk::raii::Instance& instance) {
    std::vector<Candidate> result;
    for (auto& physical : vk::raii::PhysicalDevices(instance)) {
        const auto properties = physical.getProperties();
        DeviceInfo info;
        info.name = properties.deviceName.data();
        info.type = typeText(properties.deviceType);
        info.apiVersion = versionText(properties.apiVersion);
        info.unsuitable = whyUnsuitable(physical);
        if (properties.apiVersion >= kApiVersion) { // older devices cannot be queried for these
            const auto chain =
                physical
                    .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan12Properties>();
            const auto& core12 = chain.get<vk::PhysicalDeviceVulkan12Properties>();
            info.driver = fmt::format("{} {}", core12.driverName.data(), core12.driverInfo.data());
            info.limits = limitsOf(physical);
        }
        result.push_back({std::move(physical), std::move(info)});
    }
    std::ranges::stable_sort(result, {}, [](const Candidate& c) { return preference(c.info); });
    return result;
}

std::string lowerCase(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = char(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

/// The first candidate that `name` fits; throws Error(device) if there is none or it cannot be used.
Candidate choose(std::vector<Candidate> all, std::string_view name) {
    if (name.empty())
        throw Error(ErrorCode::usage, "empty device name: expected auto, cpu or part of a name");
    if (all.empty()) throw Error(ErrorCode::device, kNoDevice);
    std::string listing;
    for (Candidate& candidate : all) {
        const DeviceInfo& info = candidate.info;
        const bool fits = name == "auto" ? info.unsuitable.empty()
                                         : lowerCase(info.name).find(lowerCase(name)) != std::string::npos;
        if (fits && info.unsuitable.empty()) return std::move(candidate);
        if (fits)
            throw Error(ErrorCode::device,
                        fmt::format("device '{}' cannot be used: {}", info.name, info.unsuitable));
        listing += fmt::format("{}'{}'{}", listing.empty() ? "" : ", ", info.name,
                               info.unsuitable.empty() ? "" : " (" + info.unsuitable + ")");
    }
    throw Error(ErrorCode::device, name == "auto"
                                       ? fmt::format("no usable Vulkan device; there is {}", listing)
                                       : fmt::format("no Vulkan device '{}'; there is {}", name, listing));
}

} // namespace

std::vector<DeviceInfo> listDevices() {
    const vk::raii::Context context = makeContext();
    const vk::raii::Instance instance = makeInstance(context, nullptr);
    return checked("listing the devices", [&] {
        std::vector<DeviceInfo> result;
        for (Candidate& candidate : candidates(instance)) result.push_back(std::move(candidate.info));
        if (result.empty()) throw Error(ErrorCode::device, kNoDevice);
        return result;
    });
}

bool validationFromEnvironment() {
    const char* value = std::getenv("SLANT_VALIDATE");
    return value && *value && std::string_view(value) != "0";
}

Device::Impl::Impl(const DeviceOptions& options)
    : validate(options.validate), forceStaging(options.forceStaging), context(makeContext()),
      instance(makeInstance(context, options.validate ? &validation : nullptr)) {
    checked("opening the device", [&] {
        if (validate) messenger.emplace(instance, validation.messengerInfo());
        Candidate chosen = choose(candidates(instance), options.name);
        physical = std::move(chosen.physical);
        info = std::move(chosen.info);
        queueFamily = *computeQueueFamily(physical);
        timestampBits = physical.getQueueFamilyProperties()[queueFamily].timestampValidBits;
        memory = physical.getMemoryProperties();
        const float priority = 1;
        const vk::DeviceQueueCreateInfo queueInfo({}, queueFamily, 1, &priority);
        device = vk::raii::Device(physical, vk::DeviceCreateInfo({}, queueInfo));
        queue = device.getQueue(queueFamily, 0);
        oncePool.emplace(device,
                         vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient, queueFamily));
    });
}

std::optional<std::uint32_t> Device::Impl::memoryType(std::uint32_t typeBits,
                                                      vk::MemoryPropertyFlags wanted) const {
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((typeBits >> i & 1) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    return std::nullopt;
}

StagingBuffer& Device::Impl::staging() {
    if (stagingBuffer) return *stagingBuffer;
    return checked("allocating the staging buffer", [&]() -> StagingBuffer& {
        using Usage = vk::BufferUsageFlagBits;
        using Property = vk::MemoryPropertyFlagBits;
        const vk::BufferCreateInfo bufferInfo({}, StagingBuffer::kBytes,
                                              Usage::eTransferSrc | Usage::eTransferDst);
        vk::raii::Buffer buffer(device, bufferInfo);
        const auto needs = buffer.getMemoryRequirements();
        const auto coherent = Property::eHostVisible | Property::eHostCoherent;
        auto type = memoryType(needs.memoryTypeBits, coherent | Property::eHostCached);
        if (!type) type = memoryType(needs.memoryTypeBits, coherent); // every device must have this one
        vk::raii::DeviceMemory block(device, vk::MemoryAllocateInfo(needs.size, type.value()));
        buffer.bindMemory(*block, 0);
        auto* mapped = static_cast<std::byte*>(block.mapMemory(0, StagingBuffer::kBytes));
        return stagingBuffer.emplace(StagingBuffer{std::move(block), std::move(buffer), mapped});
    });
}

void Device::Impl::runOnce(std::string_view doing,
                           const std::function<void(const vk::raii::CommandBuffer&)>& record) {
    checked(doing, [&] {
        const vk::CommandBufferAllocateInfo allocateInfo(**oncePool, vk::CommandBufferLevel::ePrimary, 1);
        const auto commands = std::move(vk::raii::CommandBuffers(device, allocateInfo).front());
        commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
        record(commands);
        commands.end();
        const vk::raii::Fence fence(device, vk::FenceCreateInfo());
        queue.submit(vk::SubmitInfo({}, {}, *commands), *fence);
        wait(fence, doing);
    });
}

void Device::Impl::wait(const vk::raii::Fence& fence, std::string_view doing) const {
    checked(doing, [&] {
        while (device.waitForFences(*fence, true, UINT64_MAX) == vk::Result::eTimeout) {
        }
    });
}

Device::Device(const DeviceOptions& options) : impl_(std::make_unique<Impl>(options)) {
    checkValidation();
}

Device::~Device() = default;

const DeviceInfo& Device::info() const {
    return impl_->info;
}

std::uint64_t Device::allocatedBytes() const {
    return impl_->allocatedBytes;
}

std::uint64_t Device::peakBytes() const {
    return impl_->peakBytes;
}

void Device::resetPeakBytes() {
    impl_->peakBytes = impl_->allocatedBytes;
}

void Device::checkValidation() {
    const auto messages = impl_->validation.take();
    if (messages.empty()) return;
    throw Error(ErrorCode::device, fmt::format("Vulkan validation, {} message{}: {}", messages.size(),
                                               messages.size() == 1 ? "" : "s", messages.front()));
}

} // namespace slant
