#include "base/error.h"

namespace slant {

std::string FileLocation::text() const {
    if (line <= 0) return file;
    if (column <= 0) return fmt::format("{}:{}", file, line);
    return fmt::format("{}:{}:{}", file, line, column);
}

Error::Error(ErrorCode code, const FileLocation& location, const std::string& message)
    : std::runtime_error(location.file.empty() ? message : location.text() + ": " + message), code_(code) {}

} // namespace slant
