#include "base/input_file.h"

#include "base/error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace slant {

InputFile::InputFile(const std::string& path) : path_(path) {
    std::error_code error;
    const std::filesystem::file_type type = std::filesystem::status(path, error).type();
    if (type == std::filesystem::file_type::not_found) throw badInput({path}, "there is no such file");
    if (error) throw badInput({path}, "cannot read: {}", error.message());
    if (type != std::filesystem::file_type::regular) throw badInput({path}, "is not a regular file");
    descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) throw badInput({path}, "cannot read: {}", std::strerror(errno));
    struct stat status {};
    if (fstat(descriptor_, &status) != 0) {
        const int reason = errno;
        close(descriptor_);
        throw badInput({path}, "cannot read: {}", std::strerror(reason));
    }
    size_ = std::uint64_t(status.st_size);
}

InputFile::~InputFile() {
    close(descriptor_);
}

void InputFile::read(std::uint64_t offset, void* data, std::size_t bytes) const {
    char* target = static_cast<char*>(data);
    while (bytes > 0) {
        const ssize_t count = pread(descriptor_, target, bytes, off_t(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw badInput({path_}, "cannot read: {}", std::strerror(errno));
        if (count == 0) throw badInput({path_}, "cannot read: it ends early");
        offset += std::uint64_t(count);
        target += count;
        bytes -= std::size_t(count);
    }
}

} // namespace slant
