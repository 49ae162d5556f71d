// The JSON file of --stats.
#pragma once
#include "base/monitor.h"
#include "trace/sample_motion.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace slant::commands {

/// `details` (scene, method, device, ...) with "seconds" of the whole run and "stages" added: an array of
/// name, seconds, deviceSeconds, items, unit, bytes, and itemsPerSecond (null for a stage that took no time).
nlohmann::ordered_json statsJson(const std::vector<StageStats>& stages, double totalSeconds,
                                 nlohmann::ordered_json details);

/// Adds by how many pixels the straight motion of samples misses: at most, and for 99 % of them at most.
void addMisses(nlohmann::ordered_json& details, const MotionMisses& misses);

/// Writes statsJson to `path`. Throws Error(resources).
void writeStats(const std::string& path, const std::vector<StageStats>& stages, double totalSeconds,
                nlohmann::ordered_json details);

} // namespace slant::commands
