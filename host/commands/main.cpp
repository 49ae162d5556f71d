// The program: registers the commands, runs the one asked for, and turns errors into exit statuses and one
// line on stderr.
#include "base/error.h"
#include "base/suggest.h"
#include "commands/commands.h"
#include "commands/interrupt.h"
#include "commands/terminal_monitor.h"
#include "scene/issues.h"
#include "version.h"

#include <cstdio>
#include <new>
#include <stdexcept>

namespace {

using namespace slant;

int fail(ErrorCode code, std::string_view message) {
    fmt::print(stderr, "slant: error: {}\n", commands::oneLine(message));
    return int(code);
}

/// The command that was named, or the program.
const CLI::App& activeCommand(const CLI::App& program) {
    const auto named = program.get_subcommands();
    return named.empty() ? program : *named.front();
}

std::vector<std::string> optionNames(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options({}))
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

/// Unknown words come first: what the parser reports is often only their consequence.
std::string usageMessage(const CLI::App& program, const CLI::ParseError& error) {
    const CLI::App& command = activeCommand(program);
    const bool atTop = &command == &program;
    const std::string help = fmt::format("(see slant {}--help)", atTop ? "" : command.get_name() + " ");
    const std::vector<std::string> unknown = program.remaining(true);
    if (unknown.empty()) return fmt::format("{} {}", error.what(), help);

    const std::string& word = unknown.front();
    if (word.starts_with("-"))
        return fmt::format("unknown option '{}'{} {}", word, didYouMean(word, optionNames(command)), help);
    if (!atTop) return fmt::format("unexpected argument '{}' {}", word, help);
    std::vector<std::string> names;
    for (const CLI::App* each : program.get_subcommands({})) names.push_back(each->get_name());
    return fmt::format("unknown command '{}'{} {}", word, didYouMean(word, names), help);
}

void flushOutput() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
        throw Error(ErrorCode::resources, "cannot write to standard output");
}

int run(CLI::App& program, int argc, char** argv) {
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& request) { // --help, --version
        program.exit(request);
    } catch (const CLI::ParseError& error) {
        return fail(ErrorCode::usage, usageMessage(program, error));
    }
    flushOutput();
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    try {
        commands::catchInterrupts();
        commands::takeSignalsAsErrors();
        CLI::App program("Reconstructs images with defocus from a few light-field samples per pixel.",
                         "slant");
        program.set_version_flag("--version", "slant " SLANT_VERSION);
        program.require_subcommand(1);
        for (const auto add : commands::kCommands) add(program);
        return run(program, argc, argv);
    } catch (const InvalidScene& error) {
        for (const std::string& line : error.lines()) fail(error.code(), line);
        return int(error.code());
    } catch (const Error& error) {
        return fail(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::resources, "out of memory");
    } catch (const std::length_error&) {
        return fail(ErrorCode::resources, "out of memory: a buffer would exceed the address space");
    } catch (const std::exception& error) {
        return fail(ErrorCode::resources, fmt::format("unexpected: {}", error.what()));
    }
}
