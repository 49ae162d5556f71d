#include "commands/terminal_monitor.h"

#include "base/error.h"
#include "commands/interrupt.h"

#include <algorithm>
#include <cmath>
#include <sys/ioctl.h>
#include <unistd.h>

namespace slant::commands {
namespace {

constexpr double kBarInterval = 0.1; ///< seconds between two drawings
constexpr double kLineInterval = 5;
constexpr int kBarCells = 24;
constexpr const char* kClearLine = "\r\x1b[K";

/// "1.52 M", three significant digits.
std::string shortCount(double count) {
    const char* const suffixes[] = {"", " k", " M", " G", " T"};
    int i = 0;
    for (; count >= 999.5 && i < 4; ++i) count /= 1000;
    const int decimals = i == 0 || count >= 99.95 ? 0 : count >= 9.995 ? 1 : 2;
    return fmt::format("{:.{}f}{}", count, decimals, suffixes[i]);
}

/// "12 s", "3:05" or "1:02:05".
std::string shortTime(double seconds) {
    const long s = std::lround(std::min(seconds, 359999.0));
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
    return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

/// Columns of the terminal, or plenty where that is unknown.
std::size_t columns(std::FILE* stream) {
    winsize size = {};
    const bool known = ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
    return known ? size.ws_col : 200;
}

} // namespace

std::string oneLine(std::string_view text) {
    std::string line(text);
    for (char& c : line)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    return line;
}

TerminalMonitor::Style TerminalMonitor::styleOfStderr(bool quiet) {
    if (quiet) return Style::quiet;
    return isatty(STDERR_FILENO) ? Style::bar : Style::lines;
}

TerminalMonitor::~TerminalMonitor() {
    if (barShown_) std::fputc('\n', stream_);
}

void TerminalMonitor::beginStage(std::string_view name, std::uint64_t total, std::string_view unit) {
    endStage();
    const std::scoped_lock lock(mutex_);
    running_ = true;
    name_ = name;
    unit_ = unit;
    total_ = total;
    done_ = 0;
    watch_ = Stopwatch();
    nextReport_ = style_ == Style::bar ? kBarInterval : kLineInterval;
}

void TerminalMonitor::advance(std::uint64_t items) {
    if (interrupted()) throw Error(ErrorCode::interrupted, "interrupted");
    done_ += items;
    if (style_ == Style::quiet || watch_.seconds() < nextReport_) return;
    // A thread that finds another one drawing does not wait for it.
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || !running_ || watch_.seconds() < nextReport_) return;
    nextReport_ = watch_.seconds() + (style_ == Style::bar ? kBarInterval : kLineInterval);
    report(false);
}

void TerminalMonitor::endStage() {
    const std::scoped_lock lock(mutex_);
    if (!running_) return;
    running_ = false;
    stages_.push_back({name_, watch_.seconds(), 0, std::max<std::uint64_t>(total_, done_), unit_, 0});
    if (style_ != Style::quiet) report(true);
}

void TerminalMonitor::warn(std::string_view message) {
    const std::scoped_lock lock(mutex_);
    if (barShown_) std::fputs(kClearLine, stream_);
    barShown_ = false;
    fmt::print(stream_, "slant: warning: {}\n", oneLine(message));
}

/// Draws the bar or prints the line of the stage at hand; the mutex is held.
void TerminalMonitor::report(bool finished) {
    const double seconds = watch_.seconds();
    const std::uint64_t done =
        finished ? std::max<std::uint64_t>(total_, done_) : std::min(done_.load(), total_);
    const double fraction = finished ? 1 : total_ == 0 ? 0 : double(done) / double(total_);
    const double rate = seconds > 0 ? double(done) / seconds : 0;
    const std::string speed = fmt::format("{} {}/s", shortCount(rate), unit_);
    const std::string time = finished   ? fmt::format("{:.2f} s", seconds)
                             : rate > 0 ? shortTime(double(total_ - done) / rate) + " left"
                                        : std::string("waiting");
    const int percent = int(100 * fraction);
    if (style_ == Style::lines) {
        fmt::print(stream_, "slant: {} {} %, {}, {}\n", name_, percent, speed, time);
        return;
    }
    const int cells = int(kBarCells * fraction);
    const std::string line = fmt::format("{:<12} [{:#<{}}{:-<{}}] {:3} %  {}, {}", name_, "", cells, "",
                                         kBarCells - cells, percent, speed, time);
    fmt::print(stream_, "{}{}{}", kClearLine, line.substr(0, columns(stream_) - 1), finished ? "\n" : "");
    std::fflush(stream_);
    barShown_ = !finished;
}

} // namespace slant::commands
