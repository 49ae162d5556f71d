// Collects what the Khronos validation layer says.
#pragma once
#include <mutex>
#include <string>
#include <vector>
#include <vulkan/vulkan.hpp>

namespace slant {

class ValidationLog {
public:
    static constexpr const char* kLayer = "VK_LAYER_KHRONOS_validation";

    /// Describes a messenger that appends warnings and errors to this log, which must outlive it.
    vk::DebugUtilsMessengerCreateInfoEXT messengerInfo();
    /// What was collected since the last call; the layer may call from any thread meanwhile.
    std::vector<std::string> take();

private:
    static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                  VkDebugUtilsMessageTypeFlagsEXT type,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                  void* log);

    std::mutex mutex_;
    std::vector<std::string> messages_;
};

} // namespace slant
