// The subcommands of the program. A command is one file commands/NAME.cpp that exposes one function, which
// adds the subcommand, its options and a callback that does the work; it is declared here and listed in
// kCommands. Callbacks throw slant::Error (or CLI::ParseError for wrong options); main turns these into
// exit statuses.
#pragma once
#include <CLI/CLI.hpp>
#include <initializer_list>

namespace slant::commands {

using AddCommand = void (*)(CLI::App& program);

void addRender(CLI::App& program);
void addReference(CLI::App& program);
void addSample(CLI::App& program);
void addCheck(CLI::App& program);
void addReconstruct(CLI::App& program);
void addInfo(CLI::App& program);
void addDiff(CLI::App& program);
void addChart(CLI::App& program);
void addLens(CLI::App& program);
void addDevices(CLI::App& program);

/// In the order in which `slant --help` lists them.
inline constexpr std::initializer_list<AddCommand> kCommands = {
    addRender, addReference, addSample, addReconstruct, addInfo,
    addCheck,  addDiff,      addChart,  addLens,        addDevices};

} // namespace slant::commands
