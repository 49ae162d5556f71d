// The rooms of host/ depend downwards only (host/README.md), two libraries stay in one room
// each, and files stay short enough to have one reason to change.
#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <regex>
#include <string>
#include <vector>

namespace slant {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = SLANT_SOURCE_DIR;
constexpr std::size_t kMaxLines = 400;

/// From the lowest to the highest.
constexpr std::array kRooms{"base",        "image",   "scene",  "camera", "lightfield", "trace",
                            "reconstruct", "compute", "render", "report", "commands"};

/// Though the order would allow it: the light field is all that tracing and reconstruction share.
constexpr std::array<std::array<const char*, 2>, 2> kStrangers{
    {{"reconstruct", "trace"}, {"compute", "trace"}}};

/// Libraries that a single room may see.
constexpr std::array<std::array<const char*, 2>, 2> kHidden{{{"embree", "trace"}, {"vulkan", "compute"}}};

std::optional<std::size_t> rank(const std::string& room) {
    const auto found = std::find(kRooms.begin(), kRooms.end(), room);
    if (found == kRooms.end()) return std::nullopt;
    return std::size_t(found - kRooms.begin());
}

/// Why a file of `room` must not include `path` (quoted or not); empty if it may.
std::string objection(const std::string& room, const std::string& path, bool quoted) {
    for (const auto& [library, only] : kHidden)
        if (path.starts_with(library) && room != only)
            return fmt::format("{} is for {}/ alone", library, only);
    if (!quoted || path.starts_with("shared/") || path.starts_with("lib/")) return "";
    if (path == "shaders_embedded.h") return room == "compute" ? "" : "shaders are for compute/ alone";
    if (path == "version.h") return room == "commands" ? "" : "the version is for commands/ alone";
    const std::string other = path.substr(0, path.find('/'));
    if (!rank(other)) return "not the path of a room's header";
    if (*rank(other) > *rank(room)) return fmt::format("{} is above {}", other, room);
    for (const auto& [from, to] : kStrangers)
        if (room == from && other == to) return fmt::format("{} must not know {}", from, to);
    return "";
}

std::vector<std::string> linesOf(const fs::path& path) {
    std::ifstream in(path);
    EXPECT_TRUE(in) << path;
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

std::vector<fs::path> filesUnder(const char* folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(kSource / folder))
        if (entry.is_regular_file() && entry.path().extension() != ".md") files.push_back(entry.path());
    return files;
}

TEST(Rooms, dependDownwardsOnly) {
    const std::regex include(R"re(\s*#\s*include\s*([<"])([^>"]+)[>"].*)re");
    std::size_t includes = 0;
    for (const fs::path& file : filesUnder("host")) {
        const std::string room = fs::relative(file, kSource / "host").begin()->string();
        ASSERT_TRUE(rank(room)) << file << " is in no known room";
        for (const std::string& line : linesOf(file)) {
            std::smatch match;
            if (!std::regex_match(line, match, include)) continue;
            ++includes;
            EXPECT_EQ(objection(room, match[2], match[1] == "\""), "") << file << ": " << line;
        }
    }
    EXPECT_GT(includes, 20u);
}

TEST(Rooms, theCheckRefusesWhatIsForbidden) {
    EXPECT_NE(objection("image", "scene/scene.h", true), "");
    EXPECT_NE(objection("reconstruct", "trace/tracer.h", true), "");
    EXPECT_NE(objection("trace", "reconstruct/full.h", true), "");
    EXPECT_NE(objection("compute", "trace/tracer.h", true), "");
    EXPECT_NE(objection("base", "../trace/tracer.h", true), "");
    EXPECT_NE(objection("scene", "embree4/rtcore.h", false), "");
    EXPECT_NE(objection("report", "vulkan/vulkan_raii.hpp", false), "");
    EXPECT_EQ(objection("trace", "embree3/rtcore.h", false), "");
    EXPECT_EQ(objection("compute", "reconstruct/full.h", true), "");
    EXPECT_EQ(objection("commands", "trace/tracer.h", true), "");
}

TEST(Rooms, filesAreShort) {
    for (const char* folder : {"host", "shaders", "tests"})
        for (const fs::path& file : filesUnder(folder)) EXPECT_LE(linesOf(file).size(), kMaxLines) << file;
}

} // namespace
} // namespace slant
