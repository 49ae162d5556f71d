// The one exception type of the library, its codes, and the place in a file that an error points at.
// The library throws Error; it never prints and never exits. main alone turns a code into an exit status.
#pragma once
#include <fmt/format.h>
#include <stdexcept>
#include <string>

namespace slant {

/// The value is the program's exit status (host/commands/README.md, "Exit status").
enum class ErrorCode {
    outOfBounds = 1, ///< `slant diff`: the images differ by more than the bounds allow
    usage = 2,       ///< wrong options or arguments
    badInput = 3,    ///< a file that is missing, malformed or outside the supported subset
    device = 4,      ///< no such Vulkan device, or the device was lost
    resources = 5,   ///< out of memory or disk, an output that cannot be written, or no gnuplot
    interrupted = 130,
};

/// A place in an input file; line and column count from 1, 0 = unknown (the file as a whole).
struct FileLocation {
    std::string file;
    int line = 0;
    int column = 0;

    /// "file:line:column", without the parts that are unknown.
    std::string text() const;
};

class Error : public std::runtime_error {
public:
    Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    /// what() reads "file:line:column: message".
    Error(ErrorCode code, const FileLocation& location, const std::string& message);

    ErrorCode code() const { return code_; }
    /// Where it is; empty if the error has no place.
    const FileLocation& location() const { return location_; }
    /// what() without the place.
    std::string message() const;

private:
    ErrorCode code_;
    FileLocation location_;
};

/// throw badInput("{} is not a number", word) with the place where it stands.
template <typename... Args>
Error badInput(const FileLocation& location, fmt::format_string<Args...> format, Args&&... args) {
    return Error(ErrorCode::badInput, location, fmt::format(format, std::forward<Args>(args)...));
}

} // namespace slant
