// What the README files promise: every command in an ```sh block runs as written, the blocks of one file in
// their order in one empty folder; every relative link of any .md file leads somewhere; and the front README
// stays short.
#include "support/run_program.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <gtest/gtest.h>
#include <ostream>
#include <regex>
#include <set>
#include <sstream>

namespace slant {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = SLANT_SOURCE_DIR;
constexpr std::size_t kMaxFrontLines = 170;

std::vector<std::string> linesOf(const fs::path& path) {
    std::istringstream text(test::readText(path.string()));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
}

/// The .md files of the tree, relative to it; without what is built or written beside it.
std::vector<fs::path> documents() {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(kSource))
        if (entry.path().extension() == ".md") found.push_back(entry.path().filename());
    for (const char* folder : {".github", "cmake", "host", "scenes", "shaders", "tests"})
        if (fs::is_directory(kSource / folder))
            for (const auto& entry : fs::recursive_directory_iterator(kSource / folder))
                if (entry.is_regular_file() && entry.path().extension() == ".md")
                    found.push_back(fs::relative(entry.path(), kSource));
    std::ranges::sort(found);
    return found;
}

/// Lines of ```sh blocks.
std::vector<std::string> commandsOf(const fs::path& document) {
    std::vector<std::string> commands;
    bool inside = false;
    for (const std::string& line : linesOf(kSource / document)) {
        if (line.starts_with("```"))
            inside = line == "```sh";
        else if (inside && !line.empty())
            commands.push_back(line);
    }
    return commands;
}

/// A document, and its name as the name of a test.
struct Document {
    fs::path path;
    std::string name() const {
        std::string name = path.string();
        std::ranges::replace_if(
            name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
        return name;
    }
};
std::ostream& operator<<(std::ostream& out, const Document& document) {
    return out << document.path.string();
}

std::vector<Document> documentsWithCommands() {
    std::vector<Document> found;
    for (const fs::path& path : documents())
        if (!commandsOf(path).empty()) found.push_back({path});
    return found;
}

bool startsWithAny(const std::string& text, std::initializer_list<const char*> heads) {
    return std::ranges::any_of(heads, [&](const char* head) { return text.starts_with(head); });
}

/// The command with options that make it quick.
std::string shortened(std::string command) {
    const bool renders =
        startsWithAny(command, {"slant render scenes/", "slant reference scenes/", "slant sample scenes/"});
    if (renders && command.find("--crop") == std::string::npos) command += " --crop 250,266,150,159";
    if (command.starts_with("slant chart"))
        command += " --spp 1 --outputs 1 --truth-spp 64 --repeat 1 --cache cache";
    return command;
}

class ReadmeCommands : public testing::TestWithParam<Document> {};

TEST_P(ReadmeCommands, workAsWritten) {
    const test::TempDir dir;
    fs::create_directory_symlink(kSource / "scenes", dir.path() / "scenes");
    fs::create_symlink(SLANT_PROGRAM, dir.path() / "slant");
    for (const std::string& command : commandsOf(GetParam().path)) {
        ASSERT_TRUE(command.starts_with("slant ")) << command << "\nother commands go into indented blocks";
        const auto run = test::runWords(
            {"sh", "-c",
             "cd " + test::shellQuote(dir.path().string()) + " && PATH=.:$PATH && " + shortened(command)});
        EXPECT_EQ(run.status, 0) << command << "\n" << run.err;
    }
}

INSTANTIATE_TEST_SUITE_P(Documents, ReadmeCommands, testing::ValuesIn(documentsWithCommands()),
                         [](const auto& document) { return document.param.name(); });

TEST(Readme, commandsAreFound) {
    EXPECT_GE(commandsOf("README.md").size(), 6u);
    EXPECT_GE(documentsWithCommands().size(), 5u);
}

/// The anchor of a heading in a link, as GitHub forms it.
std::string anchorOf(const std::string& heading) {
    std::string anchor;
    for (const unsigned char c : heading.substr(heading.find_first_not_of("# "))) {
        if (c == ' ' || c == '-')
            anchor += '-';
        else if (std::isalnum(c) != 0 || c == '_' || c >= 0x80)
            anchor += char(std::tolower(c));
    }
    return anchor;
}

/// Calls visit(line) for the lines that are text: outside of fenced and indented blocks.
template <typename Visit>
void forEachTextLine(const fs::path& document, const Visit& visit) {
    bool fenced = false;
    for (const std::string& line : linesOf(kSource / document)) {
        if (line.starts_with("```")) fenced = !fenced;
        if (!fenced && !line.starts_with("    ")) visit(line);
    }
}

std::set<std::string> anchorsOf(const fs::path& document) {
    std::set<std::string> anchors;
    forEachTextLine(document, [&](const std::string& line) {
        if (line.starts_with("#")) anchors.insert(anchorOf(line));
    });
    return anchors;
}

TEST(Readme, linksLeadSomewhere) {
    const std::regex link(R"(\]\(([^)\s]+)\))");
    std::size_t links = 0;
    for (const fs::path& document : documents())
        forEachTextLine(document, [&](const std::string& line) {
            for (std::sregex_iterator i(line.begin(), line.end(), link), end; i != end; ++i) {
                const std::string target = (*i)[1];
                if (startsWithAny(target, {"http://", "https://", "mailto:"})) continue;
                ++links;
                const std::size_t hash = target.find('#');
                const std::string path = target.substr(0, hash);
                const fs::path file =
                    path.empty() ? document : (document.parent_path() / path).lexically_normal();
                if (!fs::exists(kSource / file))
                    ADD_FAILURE() << document << ": no file " << target;
                else if (hash != std::string::npos && !anchorsOf(file).contains(target.substr(hash + 1)))
                    ADD_FAILURE() << document << ": no heading " << target;
            }
        });
    EXPECT_GT(links, 20u);
}

TEST(Readme, theFrontOneIsShort) {
    EXPECT_LE(linesOf(kSource / "README.md").size(), kMaxFrontLines);
}

} // namespace
} // namespace slant
