// Runs gnuplot, which draws the charts.
#pragma once
#include <string>

namespace slant {

/// Throws Error(resources) if there is no gnuplot to run.
void checkGnuplot();

/// What gnuplot writes to its standard output for `script`. Throws Error(resources) if it is missing or
/// fails, with the first line of what it says.
std::string runGnuplot(const std::string& script);

} // namespace slant
