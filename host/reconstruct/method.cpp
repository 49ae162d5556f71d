#include "reconstruct/method.h"

#include <algorithm>

namespace slant {

std::uint64_t maxDenseSamples(const ReconstructOptions& options) {
    return options.memoryBytes / 2 / sizeof(vec4);
}

StageStats& ReconstructReport::stage(const char* name, const char* unit) {
    const auto found = std::find_if(stages.begin(), stages.end(),
                                    [&](const StageStats& stage) { return stage.name == name; });
    if (found != stages.end()) return *found;
    StageStats& stage = stages.emplace_back();
    stage.name = name;
    stage.unit = unit;
    return stage;
}

} // namespace slant
