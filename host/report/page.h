// One self-contained HTML page of a sweep's results.
#pragma once
#include "report/results.h"

#include <span>
#include <string>

namespace slant {

/// The SVG files of one scene.
struct SceneCharts {
    std::string relMse, flip;
};

/// Charts, gains, pictures with their FLIP maps, and every point in a table; one entry of `charts` per scene.
/// Pictures are read from `directory` and embedded. Throws Error(badInput) if one is missing.
std::string pageOf(const Results& results, std::span<const SceneCharts> charts, const std::string& directory);

} // namespace slant
