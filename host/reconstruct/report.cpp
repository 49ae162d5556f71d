#include "reconstruct/report.h"

namespace slant {

StageStats& ReconstructReport::stage(const std::string& name, const char* unit) {
    const auto found = std::ranges::find(stages, name, &StageStats::name);
    if (found != stages.end()) return *found;
    StageStats& stage = stages.emplace_back();
    stage.name = name;
    stage.unit = unit;
    return stage;
}

} // namespace slant
