#include "base/atomic_file.h"

#include "base/error.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <unistd.h>
#include <utility>

namespace fs = std::filesystem;

namespace slant {
namespace {

constexpr int kNameAttempts = 10000;

Error cannotWrite(const std::string& target, std::string_view reason) {
    return Error(ErrorCode::resources, {target}, fmt::format("cannot write: {}", reason));
}

} // namespace

AtomicFile::AtomicFile(const std::string& target) : target_(target) {
    if (target.empty()) throw Error(ErrorCode::resources, "cannot write a file without a name");
    std::error_code error;
    const fs::path resolved = fs::weakly_canonical(target, error);
    if (error) throw cannotWrite(target, error.message());
    const fs::file_type type = fs::status(resolved, error).type();
    if (type == fs::file_type::directory) throw cannotWrite(target, "it is a directory");
    if (type == fs::file_type::character) {
        stream_ = std::fopen(target.c_str(), "wb");
        if (!stream_) fail();
        return;
    }
    const bool exists = type != fs::file_type::not_found;
    if (exists && type != fs::file_type::regular) throw cannotWrite(target, "it is not a file");
    // A rename would replace a file that its owner has made read-only.
    if (exists && access(resolved.c_str(), W_OK) != 0) fail();

    final_ = resolved.string();
    for (int attempt = 0; !stream_ && attempt < kNameAttempts; ++attempt) {
        temporary_ = (resolved.parent_path() / fmt::format(".slant-{}-{}.part", getpid(), attempt)).string();
        stream_ = std::fopen(temporary_.c_str(), "wbx");
        if (!stream_ && errno != EEXIST) break;
    }
    if (!stream_) fail();
}

AtomicFile::~AtomicFile() {
    if (stream_) std::fclose(stream_);
    if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void AtomicFile::write(const void* data, std::size_t bytes) {
    if (std::fwrite(data, 1, bytes, stream_) != bytes) fail();
}

void AtomicFile::seek(std::uint64_t position) {
    if (fseeko(stream_, off_t(position), SEEK_SET) != 0) fail();
}

void AtomicFile::commit() {
    if (std::fclose(std::exchange(stream_, nullptr)) != 0) fail();
    if (temporary_.empty()) return;
    if (std::rename(temporary_.c_str(), final_.c_str()) != 0) fail();
    temporary_.clear();
}

void AtomicFile::fail() const {
    throw cannotWrite(target_, std::strerror(errno));
}

void checkWritable(const std::string& path) {
    const AtomicFile probe(path);
}

} // namespace slant
