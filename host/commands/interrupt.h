// Ctrl-C and SIGTERM ask the program to stop; it does so at the next Monitor::advance, so that destructors
// run and no temporary file is left behind.
#pragma once

namespace slant::commands {

/// From now on the first SIGINT or SIGTERM only sets a flag; a second one of the same kind ends the program
/// at once.
void catchInterrupts();

/// From now on writing beyond the limit of a file's size, or to a pipe that nobody reads, fails as a full
/// disc does, instead of ending the program with a temporary file left behind.
void takeSignalsAsErrors();

/// Whether such a signal has come. Any thread.
bool interrupted();

} // namespace slant::commands
