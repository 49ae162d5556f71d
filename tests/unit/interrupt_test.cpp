// Signals last for the life of a process, so each case dies in one of its own.
#include "commands/interrupt.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "commands/terminal_monitor.h"
#include "support/temp_dir.h"

#include <csignal>
#include <gtest/gtest.h>

namespace slant::commands {
namespace {

/// Works under an open output until it is told to stop; exits with the code of the error that stopped it.
[[noreturn]] void workUntilStopped(int signal, const std::string& output) {
    catchInterrupts();
    int status = 0;
    try {
        TerminalMonitor monitor(TerminalMonitor::Style::quiet);
        AtomicFile file(output);
        monitor.beginStage("work", 3, "items");
        monitor.advance(1);
        std::raise(signal);
        monitor.advance(1);
        file.commit();
    } catch (const Error& error) {
        status = int(error.code());
    }
    std::exit(status);
}

TEST(InterruptDeathTest, stopsAtTheNextAdvanceAndLeavesNoFile) {
    const test::TempDir dir;
    for (const int signal : {SIGINT, SIGTERM}) {
        EXPECT_EXIT(workUntilStopped(signal, dir.file("out")), testing::ExitedWithCode(130), "");
        EXPECT_EQ(dir.entries(), 0u);
    }
}

TEST(InterruptDeathTest, secondSignalEndsAtOnce) {
    const auto signalTwice = [] {
        catchInterrupts();
        std::raise(SIGINT);
        std::raise(SIGINT);
    };
    EXPECT_EXIT(signalTwice(), testing::KilledBySignal(SIGINT), "");
}

} // namespace
} // namespace slant::commands
