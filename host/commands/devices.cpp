// slant devices: the Vulkan devices of this machine and which of them a run would use.
#include "base/error.h"
#include "commands/commands.h"
#include "compute/device.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

namespace slant::commands {
namespace {

std::string megabytes(std::uint64_t bytes) {
    return fmt::format("{} MiB", bytes >> 20);
}

void printList(const std::vector<DeviceInfo>& devices, const DeviceInfo* best) {
    for (const DeviceInfo& device : devices) {
        fmt::print("{} {}\n", &device == best ? "*" : " ", device.name);
        fmt::print("    type        {}, {}, Vulkan {}\n", device.type, device.driver, device.apiVersion);
        if (!device.unsuitable.empty()) {
            fmt::print("    unsuitable  {}\n", device.unsuitable);
            continue;
        }
        const DeviceLimits& limits = device.limits;
        fmt::print("    memory      {}, largest allocation {}\n", megabytes(limits.heapBytes),
                   megabytes(limits.allocationBytes));
        fmt::print("    buffers     {} texels, storage ranges of {}\n", limits.texelBufferElements,
                   megabytes(limits.storageBufferBytes));
        fmt::print("    dispatches  {} x {} workgroups of {} invocations, subgroups of {}, {} bytes of push "
                   "constants\n",
                   limits.workgroupsX, limits.workgroupsY, limits.workgroupInvocations, limits.subgroupSize,
                   limits.pushConstantBytes);
        fmt::print("    timestamps  {}\n", limits.timestampNanoseconds > 0
                                               ? fmt::format("every {:g} ns", limits.timestampNanoseconds)
                                               : "none");
    }
    fmt::print("* is what --device auto takes; --device cpu stands for the program's own C++ code\n");
}

void printJson(const std::vector<DeviceInfo>& devices, const DeviceInfo* best) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const DeviceInfo& device : devices) {
        const DeviceLimits& limits = device.limits;
        list.push_back({{"name", device.name},
                        {"type", device.type},
                        {"driver", device.driver},
                        {"apiVersion", device.apiVersion},
                        {"auto", &device == best},
                        {"unsuitable", device.unsuitable},
                        {"limits",
                         {{"heapBytes", limits.heapBytes},
                          {"allocationBytes", limits.allocationBytes},
                          {"texelBufferElements", limits.texelBufferElements},
                          {"storageBufferBytes", limits.storageBufferBytes},
                          {"workgroupsX", limits.workgroupsX},
                          {"workgroupsY", limits.workgroupsY},
                          {"workgroupInvocations", limits.workgroupInvocations},
                          {"subgroupSize", limits.subgroupSize},
                          {"sharedMemoryBytes", limits.sharedMemoryBytes},
                          {"pushConstantBytes", limits.pushConstantBytes},
                          {"timestampNanoseconds", limits.timestampNanoseconds}}}});
    }
    fmt::print("{}\n", list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void runDevices(bool json) {
    const std::vector<DeviceInfo> devices = listDevices();
    const auto usable = std::ranges::find(devices, "", &DeviceInfo::unsuitable); // in the order of preference
    const DeviceInfo* best = usable == devices.end() ? nullptr : &*usable;
    if (json)
        printJson(devices, best);
    else
        printList(devices, best);
}

} // namespace

void addDevices(CLI::App& program) {
    CLI::App* command = program.add_subcommand("devices", "List the Vulkan devices and what would be used");
    const auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "print JSON instead of a list");
    command->callback([json] { runDevices(*json); });
}

} // namespace slant::commands
