#include "base/read_file.h"

#include "base/error.h"
#include "base/input_file.h"

#include <stdexcept>

namespace slant {

std::string readFile(const std::string& path) {
    const InputFile file(path);
    std::string bytes;
    try {
        bytes.resize(file.size());
    } catch (const std::exception&) { // bad_alloc or length_error
        throw Error(ErrorCode::resources, {path}, "no memory to read it");
    }
    file.read(0, bytes.data(), bytes.size());
    return bytes;
}

} // namespace slant
