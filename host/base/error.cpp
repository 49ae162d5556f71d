#include "base/error.h"

namespace slant {

std::string FileLocation::text() const {
    if (line <= 0) return file;
    if (column <= 0) return fmt::format("{}:{}", file, line);
    return fmt::format("{}:{}:{}", file, line, column);
}

Error::Error(ErrorCode code, const FileLocation& location, const std::string& message)
    : std::runtime_error(location.file.empty() ? message : location.text() + ": " + message), code_(code),
      location_(location) {}

std::string Error::message() const {
    return std::string(what()).substr(location_.file.empty() ? 0 : location_.text().size() + 2);
}

} // namespace slant
