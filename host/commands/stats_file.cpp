#include "commands/stats_file.h"

#include "base/atomic_file.h"

namespace slant::commands {

nlohmann::ordered_json statsJson(const std::vector<StageStats>& stages, double totalSeconds,
                                 nlohmann::ordered_json details) {
    auto list = nlohmann::ordered_json::array();
    for (const StageStats& stage : stages) {
        nlohmann::ordered_json entry = {
            {"name", stage.name},       {"seconds", stage.seconds}, {"deviceSeconds", stage.deviceSeconds},
            {"items", stage.items},     {"unit", stage.unit},       {"bytes", stage.bytes},
            {"itemsPerSecond", nullptr}};
        if (stage.seconds > 0) entry["itemsPerSecond"] = double(stage.items) / stage.seconds;
        list.push_back(std::move(entry));
    }
    details["seconds"] = totalSeconds;
    details["stages"] = std::move(list);
    return details;
}

void addMisses(nlohmann::ordered_json& details, const MotionMisses& misses) {
    details["motionMissPx"] = {{"most", misses.mostPx()}, {"p99", misses.quantilePx(0.99)}};
}

void writeStats(const std::string& path, const std::vector<StageStats>& stages, double totalSeconds,
                nlohmann::ordered_json details) {
    // A device name or a path may hold bytes that are not UTF-8.
    constexpr auto kReplace = nlohmann::ordered_json::error_handler_t::replace;
    AtomicFile file(path);
    file.write(statsJson(stages, totalSeconds, std::move(details)).dump(2, ' ', false, kReplace) + "\n");
    file.commit();
}

} // namespace slant::commands
