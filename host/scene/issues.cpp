#include "scene/issues.h"

#include "base/monitor.h"

#include <algorithm>
#include <tuple>

namespace slant {
namespace {

constexpr std::size_t kMaxLines = 20;    ///< of a message
constexpr std::size_t kMaxIssues = 1000; ///< different ones; a file with more is no scene

void sortByPlace(std::vector<SceneIssue>& issues) {
    const auto key = [](const SceneIssue& i) { return std::tie(i.where.file, i.where.line, i.where.column); };
    std::stable_sort(issues.begin(), issues.end(),
                     [&](const SceneIssue& a, const SceneIssue& b) { return key(a) < key(b); });
}

} // namespace

std::string SceneIssue::text() const {
    const std::string place = where.file.empty() ? "" : fmt::format("{}: ", where.text());
    return place + message + (count > 1 ? fmt::format(" ({} times)", count) : "");
}

InvalidScene::InvalidScene(std::vector<SceneIssue> issues)
    : Error(ErrorCode::badInput, fmt::format("{}", fmt::join(linesOf(issues), "\n"))),
      issues_(std::move(issues)) {}

std::vector<std::string> InvalidScene::linesOf(const std::vector<SceneIssue>& issues) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < std::min(issues.size(), kMaxLines); ++i) lines.push_back(issues[i].text());
    if (issues.size() > kMaxLines)
        lines.push_back(fmt::format("and {} more; slant check lists all", issues.size() - kMaxLines));
    return lines;
}

void Issues::add(std::vector<SceneIssue>& list, SceneIssue issue) {
    const auto known = std::find_if(list.begin(), list.end(),
                                    [&](const SceneIssue& i) { return i.message == issue.message; });
    if (known != list.end())
        ++known->count;
    else
        list.push_back(std::move(issue));
}

void Issues::take(const Error& error, std::string_view standIn) {
    if (error.code() != ErrorCode::badInput || dynamic_cast<const SyntaxError*>(&error)) throw;
    const bool isUnsupported = dynamic_cast<const Unsupported*>(&error);
    if (isUnsupported && lenient_ && !standIn.empty())
        note(error.location(), fmt::format("{}; {}", error.message(), standIn));
    else
        add(issues_, {error.location(), error.message(), isUnsupported});
    if (issues_.size() >= kMaxIssues)
        throw SyntaxError(ErrorCode::badInput, fmt::format("more than {} things are wrong", kMaxIssues));
}

void Issues::note(const FileLocation& where, const std::string& message) {
    if (notes_.size() < kMaxIssues) add(notes_, {where, message});
}

void Issues::finish(Monitor& monitor) {
    sortByPlace(notes_);
    for (const SceneIssue& note : notes_) monitor.warn(note.text());
    sortByPlace(issues_);
    if (!issues_.empty()) throw InvalidScene(std::move(issues_));
}

void Issues::finish(Monitor& monitor, const Error& last) {
    sortByPlace(issues_);
    issues_.push_back({last.location(), last.message()});
    for (const SceneIssue& note : notes_) monitor.warn(note.text());
    throw InvalidScene(std::move(issues_));
}

} // namespace slant
