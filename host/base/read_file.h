// Whole files in memory, for readers of untrusted input.
#pragma once
#include <string>

namespace slant {

/// The bytes of a regular file. Throws Error(badInput) if it is missing, not a regular file (a device or pipe
/// might never end), or unreadable; Error(resources) if it does not fit into memory.
std::string readFile(const std::string& path);

} // namespace slant
