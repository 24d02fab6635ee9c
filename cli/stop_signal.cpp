#include "stop_signal.hpp"

#include <csignal>

namespace seiche::cli {
namespace {

std::atomic<bool> stop = false, is_held = false, leave = false;
static_assert(std::atomic<bool>::is_always_lock_free, "else a signal handler must not touch it");

void ask_to_stop(int) {
  (is_held.load(std::memory_order_relaxed) ? leave : stop).store(true, std::memory_order_relaxed);
}

void handle(int flags) {
  struct sigaction action = {};
  action.sa_handler = ask_to_stop;
  action.sa_flags = flags;
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

}  // namespace

const std::atomic<bool>& stop_on_signal() {
  handle(static_cast<int>(SA_RESETHAND | SA_RESTART));
  return stop;
}

bool has_stopped() { return stop; }

const std::atomic<bool>& hold_signals() {
  is_held = true;
  handle(SA_RESTART);
  return leave;
}

}  // namespace seiche::cli
