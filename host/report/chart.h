// Charts of error over seconds, as scripts for gnuplot.
#pragma once
#include "report/results.h"

#include <span>
#include <string>

namespace slant {

enum class Figure { relMse, flip };

/// A log-log chart of one scene's points: a curve for each method, number of outputs and device, the
/// reference's among them, with their Pareto front; for relMSE also what each method gains over the
/// reference, and the noise of the ground truth where it is in range. Draws an SVG on a white ground to
/// standard output.
std::string chartScript(const SceneSummary& scene, std::span<const Point> points, Figure figure);

/// "5.2x", "at least 5.2x", or an em dash where there is no factor.
std::string factorText(const std::optional<Factor>& factor);

/// The device's name up to its details in brackets.
std::string shortDevice(const std::string& device);

} // namespace slant
