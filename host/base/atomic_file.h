// Output files that are either complete or absent: written beside the target under a temporary name, and
// renamed over it on success.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace slant {

/// Owns the temporary file; it vanishes unless commit() returned. A symbolic link is followed; a device such
/// as /dev/null is written directly, since replacing it by a file would break it. Every failure is an
/// Error(resources) that names the target.
class AtomicFile {
public:
    explicit AtomicFile(const std::string& target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(const void* data, std::size_t bytes);
    void write(std::string_view text) { write(text.data(), text.size()); }
    /// Where the next write goes, in bytes from the start.
    void seek(std::uint64_t position);
    /// Makes the file complete under its name. Nothing may be written afterwards.
    void commit();

private:
    [[noreturn]] void fail() const;

    std::string target_;    ///< as the caller named it, for messages
    std::string temporary_; ///< what is written; empty for a device
    std::string final_;     ///< what it becomes
    std::FILE* stream_ = nullptr;
};

/// Throws Error(resources) if `path` could not be written; for commands, before they start to work.
void checkWritable(const std::string& path);

} // namespace slant
