#include "commands/interrupt.h"

#include <atomic>
#include <csignal>

namespace slant::commands {
namespace {

// A signal handler can reach nothing but a global.
std::atomic<bool> signalled = false;
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void onSignal(int) {
    signalled = true;
}

} // namespace

void catchInterrupts() {
    struct sigaction action = {};
    action.sa_handler = onSignal;
    action.sa_flags = int(SA_RESETHAND) | SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

void takeSignalsAsErrors() {
    for (const int signal : {SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_IGN);
}

bool interrupted() {
    return signalled;
}

} // namespace slant::commands
