// Every command that the README shows runs as it stands there, in its order, in one empty folder.
#include "support/run_program.h"

#include <gtest/gtest.h>
#include <sstream>

namespace slant {
namespace {

namespace fs = std::filesystem;

/// Lines of the README's ```sh blocks.
std::vector<std::string> readmeCommands() {
    std::istringstream text(test::readText((fs::path(SLANT_SOURCE_DIR) / "README.md").string()));
    std::vector<std::string> commands;
    bool inside = false;
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("```"))
            inside = line == "```sh";
        else if (inside && !line.empty())
            commands.push_back(line);
    }
    return commands;
}

bool renders(const std::string& command) {
    return command.starts_with("slant render scenes/") || command.starts_with("slant reference scenes/") ||
           command.starts_with("slant sample scenes/");
}

TEST(Readme, everyCommandWorksAsWritten) {
    const test::TempDir dir;
    fs::create_directory_symlink(fs::path(SLANT_SOURCE_DIR) / "scenes", dir.path() / "scenes");
    fs::create_symlink(SLANT_PROGRAM, dir.path() / "slant");
    const std::vector<std::string> commands = readmeCommands();
    EXPECT_GE(commands.size(), 6u);
    for (std::string command : commands) {
        ASSERT_TRUE(command.starts_with("slant ")) << command;
        if (renders(command) && command.find("--crop") == std::string::npos)
            command += " --crop 250,266,150,159"; // only to be quick
        if (command.starts_with("slant chart"))
            command += " --spp 1 --outputs 1 --truth-spp 64 --repeat 1 --cache cache"; // as well
        const auto run = test::runWords(
            {"sh", "-c", "cd " + test::shellQuote(dir.path().string()) + " && PATH=.:$PATH && " + command});
        EXPECT_EQ(run.status, 0) << command << "\n" << run.err;
    }
}

} // namespace
} // namespace slant
