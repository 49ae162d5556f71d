#include "report/gnuplot.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <memory>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace slant {
namespace {

/// An unnamed file: with files for all three streams neither process can block on the other.
class Scratch {
public:
    Scratch() : stream_(std::tmpfile(), &std::fclose) {
        if (!stream_)
            throw Error(ErrorCode::resources,
                        fmt::format("cannot make a temporary file: {}", std::strerror(errno)));
    }
    int descriptor() const { return fileno(stream_.get()); }

    void fill(const std::string& text) {
        if (std::fwrite(text.data(), 1, text.size(), stream_.get()) != text.size() ||
            std::fflush(stream_.get()) != 0)
            throw Error(ErrorCode::resources, "cannot write a temporary file");
        std::rewind(stream_.get());
    }
    std::string text() {
        std::rewind(stream_.get());
        std::string all;
        std::array<char, 1 << 14> block;
        while (const std::size_t count = std::fread(block.data(), 1, block.size(), stream_.get()))
            all.append(block.data(), count);
        return all;
    }

private:
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_;
};

/// Owns what posix_spawn is told about the streams.
class SpawnActions {
public:
    SpawnActions() { posix_spawn_file_actions_init(&actions_); }
    ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
    SpawnActions(const SpawnActions&) = delete;
    SpawnActions& operator=(const SpawnActions&) = delete;

    void redirect(const Scratch& to, int stream) {
        posix_spawn_file_actions_adddup2(&actions_, to.descriptor(), stream);
    }
    const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_;
};

} // namespace

std::string runGnuplot(const std::string& script) {
    Scratch in, out, err;
    in.fill(script);
    SpawnActions actions;
    actions.redirect(in, STDIN_FILENO);
    actions.redirect(out, STDOUT_FILENO);
    actions.redirect(err, STDERR_FILENO);
    std::array<char, 8> name{"gnuplot"}, readInput{"-"};
    const std::array<char*, 3> arguments{name.data(), readInput.data(), nullptr};
    pid_t process = 0;
    if (const int error =
            posix_spawnp(&process, name.data(), actions.get(), nullptr, arguments.data(), environ))
        throw Error(ErrorCode::resources,
                    fmt::format("cannot run gnuplot, which draws the charts: {} (Debian's "
                                "package is gnuplot-nox)",
                                std::strerror(error)));
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        std::string said = err.text();
        std::ranges::replace_if(
            said, [](char c) { return c == '\n' || c == '\t'; }, ' ');
        throw Error(ErrorCode::resources, "gnuplot failed: " + said);
    }
    return out.text();
}

void checkGnuplot() {
    runGnuplot("exit\n");
}

} // namespace slant
