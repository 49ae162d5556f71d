// A regular file opened for reading at any place, by any number of threads at once.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace slant {

class InputFile {
public:
    /// Throws Error(badInput) if it is missing, not a regular file (a device or pipe might never end), or
    /// unreadable.
    explicit InputFile(const std::string& path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::string& path() const { return path_; }
    std::uint64_t size() const { return size_; }
    /// Throws Error(badInput) if the file ends before offset + bytes.
    void read(std::uint64_t offset, void* data, std::size_t bytes) const;

private:
    std::string path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

} // namespace slant
