#include "compute/validation.h"

#include <algorithm>
#include <utility>

namespace slant {

vk::DebugUtilsMessengerCreateInfoEXT ValidationLog::messengerInfo() {
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
    // Messages of type eGeneral stay out: the loader uses it to complain about drivers that are not used
    // here.
    return vk::DebugUtilsMessengerCreateInfoEXT({}, Severity::eWarning | Severity::eError,
                                                Type::eValidation | Type::ePerformance, &receive, this);
}

std::vector<std::string> ValidationLog::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
}

VkBool32 ValidationLog::receive(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) {
    auto& self = *static_cast<ValidationLog*>(log);
    std::string message = data->pMessage;
    std::ranges::replace(message, '\n', ' '); // an error message is one line
    const std::lock_guard lock(self.mutex_);
    self.messages_.push_back(std::move(message));
    return VK_FALSE;
}

} // namespace slant
