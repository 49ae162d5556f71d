// What is wrong with a scene, all of it: collected while it is read, said once at the end.
#pragma once
#include "base/error.h"

#include <string>
#include <vector>

namespace slant {

class Monitor;

/// Text that has no meaning from here on: reading ends.
class SyntaxError : public Error {
public:
    using Error::Error;
};

/// What pbrt has and Slant has not: a stand-in may serve.
class Unsupported : public Error {
public:
    using Error::Error;
};

template <typename... Args>
SyntaxError syntaxError(const FileLocation& where, fmt::format_string<Args...> format, Args&&... args) {
    return SyntaxError(ErrorCode::badInput, where, fmt::format(format, std::forward<Args>(args)...));
}
template <typename... Args>
Unsupported unsupported(const FileLocation& where, fmt::format_string<Args...> format, Args&&... args) {
    return Unsupported(ErrorCode::badInput, where, fmt::format(format, std::forward<Args>(args)...));
}

/// One thing that is wrong, where it first stands, and how often.
struct SceneIssue {
    FileLocation where;
    std::string message;
    bool unsupported = false; ///< else wrong in pbrt, too
    int count = 1;

    /// "file:line:column: message (3 times)"
    std::string text() const;
};

/// A scene that is refused; what() is all of its lines.
class InvalidScene : public Error {
public:
    explicit InvalidScene(std::vector<SceneIssue> issues);
    const std::vector<SceneIssue>& issues() const { return issues_; }
    /// One for each issue, but for the last ones of very many.
    std::vector<std::string> lines() const { return linesOf(issues_); }

private:
    static std::vector<std::string> linesOf(const std::vector<SceneIssue>& issues);

    std::vector<SceneIssue> issues_;
};

/// Collects issues and, if it is lenient, what stands in for things that are not supported. Messages of the
/// same words are counted.
class Issues {
public:
    explicit Issues(bool lenient) : lenient_(lenient) {}

    bool empty() const { return issues_.empty(); }

    /// Does `work`; false if it failed with what Slant does not support, or with other bad input. `standIn`
    /// says what takes its place; empty: nothing can. Lets SyntaxError and other codes than badInput pass.
    template <typename Work>
    bool attempt(std::string_view standIn, const Work& work) {
        try {
            work();
            return true;
        } catch (const Error& error) {
            take(error, standIn);
            return false;
        }
    }
    /// Adds what an attempt ended with, in its handler. Throws it again if reading cannot go on.
    void take(const Error& error, std::string_view standIn);
    /// A warning.
    void note(const FileLocation& where, const std::string& message);

    /// Says the warnings and stand-ins. Throws InvalidScene if there are issues.
    void finish(Monitor& monitor);
    /// The same after an error with which reading ended.
    [[noreturn]] void finish(Monitor& monitor, const Error& last);

private:
    static void add(std::vector<SceneIssue>& list, SceneIssue issue);

    bool lenient_;
    std::vector<SceneIssue> issues_, notes_;
};

} // namespace slant
