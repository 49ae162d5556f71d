#include "report/machine.h"

#include "base/hash.h"
#include "base/read_file.h"

#include <ctime>
#include <fmt/chrono.h>
#include <fstream>
#include <thread>

namespace slant {
namespace {

/// What follows `name`, blanks, `separator` and blanks in the first line of a file that begins with it.
std::string valueIn(const char* path, const std::string& name, char separator) {
    std::ifstream stream(path);
    for (std::string line; std::getline(stream, line);) {
        const std::size_t at = line.find(separator);
        if (!line.starts_with(name) || at == std::string::npos) continue;
        const std::size_t begin = line.find_first_not_of(" \t\"", at + 1),
                          end = line.find_last_not_of(" \t\"");
        if (begin != std::string::npos) return line.substr(begin, end + 1 - begin);
    }
    return "unknown " + name;
}

} // namespace

std::string machineName() {
    return fmt::format("{}, {} cores, {}", valueIn("/proc/cpuinfo", "model name", ':'),
                       std::thread::hardware_concurrency(), valueIn("/etc/os-release", "PRETTY_NAME", '='));
}

std::string programDigest() {
    Hash hash;
    hash.add(readFile("/proc/self/exe"));
    return hash.hex();
}

std::string commandLine() {
    std::ifstream stream("/proc/self/cmdline", std::ios::binary);
    std::string text;
    for (std::string word; std::getline(stream, word, '\0');) {
        if (!text.empty()) text += ' ';
        const bool plain = !word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyz"
                                                                   "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                                                   "-_./,=:+@%") == std::string::npos;
        if (plain) {
            text += word;
            continue;
        }
        text += '\'';
        for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
        text += '\'';
    }
    return text;
}

std::string dateNow() {
    return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)));
}

} // namespace slant
