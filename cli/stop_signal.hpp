// Ctrl-C and SIGTERM. While a run computes, the first asks it to end, and the second ends the program at once.
#pragma once

#include <atomic>

namespace seiche::cli {

// From now on; the flag is set by the first signal.
const std::atomic<bool>& stop_on_signal();
bool has_stopped();  // has a signal come?

// From now on no signal ends the program: files are being written that nobody could write again. The flag, set by a
// signal that comes now, asks to leave out what can be had later.
const std::atomic<bool>& hold_signals();

}  // namespace seiche::cli
