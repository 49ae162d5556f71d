// Runs the built program as a person would.
#pragma once
#include "support/temp_dir.h"

#include <algorithm>
#include <string>
#include <sys/wait.h>
#include <vector>

namespace slant::test {

struct ProgramResult {
    int status = -1; ///< exit status; 128 + signal if one ended it
    std::string out, err;

    long errorLines() const { return std::count(err.begin(), err.end(), '\n'); }
};

inline std::string shellQuote(const std::string& word) {
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

/// Runs words[0] with the rest as arguments, stdin empty.
inline ProgramResult runWords(const std::vector<std::string>& words) {
    const TempDir dir;
    std::string command;
    for (const std::string& word : words) command += shellQuote(word) + ' ';
    command += "</dev/null >" + shellQuote(dir.file("out")) + " 2>" + shellQuote(dir.file("err"));
    const int wait = std::system(command.c_str());
    const int status = WIFEXITED(wait) ? WEXITSTATUS(wait) : 128 + WTERMSIG(wait);
    return {status, readText(dir.file("out")), readText(dir.file("err"))};
}

/// Runs slant.
inline ProgramResult runSlant(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), SLANT_PROGRAM);
    return runWords(arguments);
}

/// Runs words and sends SIGINT once the program catches it (bit 1 of the mask) and has had time to begin.
inline ProgramResult runAndInterrupt(const std::vector<std::string>& words) {
    const char* script = "\"$@\" & for i in $(seq 3000); do "
                         "grep -q 'SigCgt:.*[2367abef]$' /proc/$!/status && break; sleep 0.01; done; "
                         "sleep 0.3; kill -INT $!; wait $!";
    std::vector<std::string> all = {"sh", "-c", script, "sh"};
    all.insert(all.end(), words.begin(), words.end());
    return runWords(all);
}

} // namespace slant::test
