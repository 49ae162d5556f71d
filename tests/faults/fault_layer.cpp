// A Vulkan layer that makes the driver fail: the n-th of all calls that can fail so returns an error instead
// of reaching the driver. For tests of what the program then does (errors/fault_test.cpp).
//
//     SLANT_FAULT="N KIND"     from 1; KIND: host or device (out of that memory), or lost: the device, for
//     good
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <vulkan/vk_layer.h>

namespace {

struct Fault {
    std::uint64_t number = 0;
    VkResult result = VK_SUCCESS;

    bool isLoss() const { return result == VK_ERROR_DEVICE_LOST; }
};

Fault faultFromEnvironment() {
    const char* text = std::getenv("SLANT_FAULT");
    Fault fault;
    std::string kind;
    if (text && std::istringstream(text) >> fault.number >> kind)
        fault.result = kind == "lost"   ? VK_ERROR_DEVICE_LOST
                       : kind == "host" ? VK_ERROR_OUT_OF_HOST_MEMORY
                                        : VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return fault;
}

const Fault fault = faultFromEnvironment();
std::atomic<std::uint64_t> calls = 0;
std::atomic<bool> lost = false;

PFN_vkGetInstanceProcAddr nextInstanceProc = nullptr;
PFN_vkGetDeviceProcAddr nextDeviceProc = nullptr;
VkDevice theDevice = VK_NULL_HANDLE; ///< the program has one

/// A lost device runs nothing more: what the driver still runs, it may end first.
void loseDevice() {
    lost = true;
    if (!theDevice) return;
    reinterpret_cast<PFN_vkDeviceWaitIdle>(nextDeviceProc(theDevice, "vkDeviceWaitIdle"))(theDevice);
}

/// Whether the call that is made now fails; it can by losing the device only where that is true.
bool strikes(bool canLoseDevice) {
    if (fault.isLoss() && !canLoseDevice) return false;
    const bool now = ++calls == fault.number;
    if (now && fault.isLoss()) loseDevice();
    return now || lost;
}

/// A function that passes its calls on unless the fault strikes.
template <int, bool canLoseDevice, typename Function>
struct Faulty;
template <int id, bool canLoseDevice, typename... Arguments>
struct Faulty<id, canLoseDevice, VkResult(VKAPI_PTR*)(Arguments...)> {
    inline static VkResult(VKAPI_PTR* next)(Arguments...) = nullptr;

    static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments) {
        return strikes(canLoseDevice) ? fault.result : next(arguments...);
    }
};

/// What stands for a function of the device, made from the next layer's.
struct Entry {
    std::string_view name;
    PFN_vkVoidFunction (*make)(PFN_vkVoidFunction next);
};

#define FAULTY(name, canLoseDevice)                                                                          \
    Entry {                                                                                                  \
#name, [](PFN_vkVoidFunction next) {                                                                 \
            using Function = Faulty<__LINE__, canLoseDevice, PFN_##name>;                                    \
            Function::next = reinterpret_cast<PFN_##name>(next);                                             \
            return reinterpret_cast<PFN_vkVoidFunction>(&Function::call);                                    \
        }       \
    }

constexpr std::array kDeviceFunctions = {
    FAULTY(vkAllocateMemory, false),
    FAULTY(vkMapMemory, false),
    FAULTY(vkBindBufferMemory, false),
    FAULTY(vkCreateBuffer, false),
    FAULTY(vkCreateBufferView, false),
    FAULTY(vkCreateShaderModule, false),
    FAULTY(vkCreateDescriptorSetLayout, false),
    FAULTY(vkCreatePipelineLayout, false),
    FAULTY(vkCreateComputePipelines, false),
    FAULTY(vkCreateDescriptorPool, false),
    FAULTY(vkAllocateDescriptorSets, false),
    FAULTY(vkCreateCommandPool, false),
    FAULTY(vkAllocateCommandBuffers, false),
    FAULTY(vkBeginCommandBuffer, false),
    FAULTY(vkEndCommandBuffer, false),
    FAULTY(vkCreateQueryPool, false),
    FAULTY(vkCreateFence, false),
    FAULTY(vkQueueSubmit, true),
    FAULTY(vkWaitForFences, true),
    FAULTY(vkGetQueryPoolResults, true),
};

/// The link of the chain of layers that is for this one; the rest is left for the next.
template <typename LinkInfo, typename CreateInfo>
auto takeLink(const CreateInfo* info, VkStructureType type) {
    auto* link = reinterpret_cast<LinkInfo*>(const_cast<void*>(info->pNext));
    while (link && !(link->sType == type && link->function == VK_LAYER_LINK_INFO))
        link = reinterpret_cast<LinkInfo*>(const_cast<void*>(link->pNext));
    auto* const own = link->u.pLayerInfo;
    link->u.pLayerInfo = own->pNext;
    return own;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkInstance* instance) {
    const auto* link =
        takeLink<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    nextInstanceProc = link->pfnNextGetInstanceProcAddr;
    if (strikes(false)) return fault.result;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(nextInstanceProc(nullptr, "vkCreateInstance"));
    return create(info, allocator, instance);
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkDevice* device) {
    const auto* link = takeLink<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    const PFN_vkGetInstanceProcAddr instanceProc = link->pfnNextGetInstanceProcAddr;
    nextDeviceProc = link->pfnNextGetDeviceProcAddr;
    if (strikes(true)) return fault.result;
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(instanceProc(nullptr, "vkCreateDevice"));
    const VkResult result = create(physical, info, allocator, device);
    if (result == VK_SUCCESS) theDevice = *device;
    return result;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceProc(VkDevice device, const char* name) {
    const PFN_vkVoidFunction next = nextDeviceProc(device, name);
    const auto entry = std::find_if(kDeviceFunctions.begin(), kDeviceFunctions.end(),
                                    [&](const Entry& each) { return each.name == name; });
    if (std::string_view(name) == "vkGetDeviceProcAddr")
        return reinterpret_cast<PFN_vkVoidFunction>(&deviceProc);
    return next && entry != kDeviceFunctions.end() ? entry->make(next) : next;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceProc(VkInstance instance, const char* name) {
    const std::string_view wanted = name;
    if (wanted == "vkCreateInstance") return reinterpret_cast<PFN_vkVoidFunction>(&createInstance);
    if (wanted == "vkCreateDevice") return reinterpret_cast<PFN_vkVoidFunction>(&createDevice);
    if (wanted == "vkGetInstanceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(&instanceProc);
    if (wanted == "vkGetDeviceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(&deviceProc);
    return nextInstanceProc ? nextInstanceProc(instance, name) : nullptr;
}

} // namespace

/// Where the loader begins.
extern "C" VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* version) {
    version->loaderLayerInterfaceVersion = std::min(version->loaderLayerInterfaceVersion, 2u);
    version->pfnGetInstanceProcAddr = &instanceProc;
    version->pfnGetDeviceProcAddr = &deviceProc;
    version->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
