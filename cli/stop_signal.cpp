#include "stop_signal.hpp"

#include <csignal>

namespace seiche::cli {
namespace {

std::atomic<bool> stop = false, save = false, is_held = false, leave = false;
static_assert(std::atomic<bool>::is_always_lock_free, "else a signal handler must not touch it");

// The first signal ends the run, whose files are then completed; a second one that comes meanwhile hurries that.
void ask_to_stop(int) {
  const bool is_first = !stop.exchange(true, std::memory_order_relaxed);
  if (!is_first && is_held.load(std::memory_order_relaxed)) leave.store(true, std::memory_order_relaxed);
}
void ask_to_save(int) { save.store(true, std::memory_order_relaxed); }

void handle(int signal, void (*handler)(int), int flags = 0) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESTART) | flags;
  sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
  struct sigaction action = {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void handle_all(int flags) {
  for (const int signal : {SIGINT, SIGTERM}) handle(signal, ask_to_stop, flags);
  // These come again, whether anybody has lost patience or not.
  if (!is_ignored(SIGHUP)) handle(SIGHUP, ask_to_stop);
  handle(SIGXCPU, ask_to_stop);
}

}  // namespace

const std::atomic<bool>& stop_on_signal() {
  handle_all(static_cast<int>(SA_RESETHAND));
  return stop;
}

bool has_stopped() { return stop; }

std::atomic<bool>& save_on_signal() {
  handle(SIGUSR1, ask_to_save);
  return save;
}

void outlive_readers() { handle(SIGPIPE, SIG_IGN); }

const std::atomic<bool>& hold_signals() {
  is_held = true;
  handle_all(0);
  return leave;
}

}  // namespace seiche::cli
