// Where and when a sweep ran.
#pragma once
#include <string>

namespace slant {

/// Processor, cores and operating system, in words; "unknown ..." for what the system does not tell.
std::string machineName();

/// Digest of the running program's own file: another build has another one. Throws Error(badInput) if it
/// cannot be read.
std::string programDigest();

/// The words that started the running program, quoted for a shell where they need it.
std::string commandLine();

/// Date and time, UTC: "2026-11-22 06:30 UTC".
std::string dateNow();

} // namespace slant
