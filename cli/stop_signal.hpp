// What signals ask of a run. While it computes, the first of Ctrl-C, TERM, HUP and XCPU asks it to end, and a second
// Ctrl-C or TERM ends the program at once; USR1 asks for a checkpoint.
#pragma once

#include <atomic>

namespace seiche::cli {

// First thing in the program: signals wait until it is known what they are to do. With the GNU C library they do so
// before main, since the libraries take longer to begin than many runs.
void keep_signals_waiting();
void let_signals_through();  // of commands that answer none: they end the program

// Of a run that is being set up: those that waited come now. USR1 asks for the first checkpoint; the others end the
// program at once with exit code 130, since nothing is lost yet, and say so by `sentence`, a literal, if there is one.
// A reader of our messages that has gone ends no run.
void answer_signals(const char* sentence);

// From now on; the flag is set by the first signal. HUP stays ignored where the program was started so (nohup).
const std::atomic<bool>& stop_on_signal();
bool has_stopped();  // true once a signal has come

// Set by USR1; whoever answers clears it.
std::atomic<bool>& save_on_signal();

// From now on no signal ends the program: files are being written that cannot be made later. The first signal of
// all still lets everything be written. The flag, set by one behind it, asks to leave out what can be had later.
const std::atomic<bool>& hold_signals();

}  // namespace seiche::cli
