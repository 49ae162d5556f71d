// slant check: whether a scene is supported, and what of it is not.
#include "commands/commands.h"
#include "commands/picture_job.h"
#include "scene/issues.h"

#include <algorithm>
#include <memory>

namespace slant::commands {
namespace {

struct CheckOptions {
    std::string scene;
    ReadOptions reading;
    bool json = false;
};

/// Keeps warnings.
class WarningList final : public Monitor {
public:
    void beginStage(std::string_view, std::uint64_t, std::string_view) override {}
    void advance(std::uint64_t) override {}
    void endStage() override {}
    void warn(std::string_view message) override { warnings.emplace_back(message); }

    std::vector<std::string> warnings;
};

std::vector<SceneIssue> issuesOf(const CheckOptions& options, Monitor& monitor) {
    try {
        readScene(options.scene, monitor, options.reading);
    } catch (const InvalidScene& invalid) {
        return invalid.issues();
    }
    return {};
}

void printJson(const std::string& scene, const std::vector<SceneIssue>& issues,
               const std::vector<std::string>& warnings) {
    nlohmann::ordered_json json = {{"scene", scene},
                                   {"accepted", issues.empty()},
                                   {"issues", nlohmann::ordered_json::array()},
                                   {"warnings", warnings}};
    for (const SceneIssue& issue : issues)
        json["issues"].push_back({{"file", issue.where.file},
                                  {"line", issue.where.line},
                                  {"column", issue.where.column},
                                  {"message", issue.message},
                                  {"unsupported", issue.unsupported},
                                  {"count", issue.count}});
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void printText(const std::string& scene, const std::vector<SceneIssue>& issues,
               const std::vector<std::string>& warnings) {
    for (const SceneIssue& issue : issues) fmt::print("{}\n", oneLine(issue.text()));
    for (const std::string& warning : warnings) fmt::print("warning: {}\n", oneLine(warning));
    if (issues.empty()) fmt::print("{}: accepted\n", oneLine(scene));
}

void runCheck(const CheckOptions& options) {
    WarningList monitor;
    const std::vector<SceneIssue> issues = issuesOf(options, monitor);
    (options.json ? printJson : printText)(options.scene, issues, monitor.warnings);
    if (issues.empty()) return;
    const auto lacking =
        std::count_if(issues.begin(), issues.end(), [](const SceneIssue& i) { return i.unsupported; });
    throw badInput({options.scene}, "{} not supported, {} wrong", lacking,
                   issues.size() - std::size_t(lacking));
}

} // namespace

void addCheck(CLI::App& program) {
    CLI::App* command = program.add_subcommand("check", "List all of a scene that is not supported or wrong");
    const auto options = std::make_shared<CheckOptions>();
    addSceneOptions(*command, options->scene, options->reading);
    command->add_flag("--json", options->json, "print JSON instead of lines");
    command->callback([options] { runCheck(*options); });
}

} // namespace slant::commands
