#include "base/read_file.h"

#include "base/error.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>

namespace slant {

std::string readFile(const std::string& path) {
    std::error_code error;
    const std::filesystem::file_type type = std::filesystem::status(path, error).type();
    if (type == std::filesystem::file_type::not_found) throw badInput({path}, "there is no such file");
    if (error) throw badInput({path}, "cannot read: {}", error.message());
    if (type != std::filesystem::file_type::regular) throw badInput({path}, "is not a regular file");

    std::ifstream stream(path, std::ios::binary | std::ios::ate);
    if (!stream) throw badInput({path}, "cannot read: {}", std::strerror(errno));
    std::string bytes;
    try {
        bytes.resize(std::size_t(stream.tellg()));
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::resources, {path}, "no memory to read it");
    }
    stream.seekg(0);
    if (!stream.read(bytes.data(), std::streamsize(bytes.size())))
        throw badInput({path}, "cannot read: it ends early");
    return bytes;
}

} // namespace slant
