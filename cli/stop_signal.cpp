#include "stop_signal.hpp"

#include "command_line.hpp"

#include <unistd.h>

#include <csignal>
#include <initializer_list>
#include <string_view>

namespace seiche::cli {
namespace {

std::atomic<bool> stop = false, save = false, is_held = false, leave = false;
static_assert(std::atomic<bool>::is_always_lock_free, "else a signal handler must not touch it");

std::atomic<const char*> end_of_set_up = "";
static_assert(std::atomic<const char*>::is_always_lock_free);

void end_set_up(int) {
  const std::string_view sentence = end_of_set_up.load(std::memory_order_relaxed);
  for (const std::string_view text : {std::string_view("seiche: "), sentence, std::string_view("\n")})
    if (!sentence.empty()) [[maybe_unused]]
      const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
  ::_exit(interrupted);
}

// The first signal ends the run, whose files are then completed; a second INT or TERM meanwhile hurries that.
// A terminal that is closed and a limit of processor time repeat theirs.
void ask_to_stop(int signal) {
  const bool is_first = !stop.exchange(true, std::memory_order_relaxed);
  if (!is_first && (signal == SIGINT || signal == SIGTERM) && is_held.load(std::memory_order_relaxed))
    leave.store(true, std::memory_order_relaxed);
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

void handle_all(void (*handler)(int), int flags) {
  for (const int signal : {SIGINT, SIGTERM}) handle(signal, handler, flags);
  // The system may send these more than once: a second one is no request to end at once.
  if (!is_ignored(SIGHUP)) handle(SIGHUP, handler);
  handle(SIGXCPU, handler);
}

void change_mask(int how) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1}) sigaddset(&set, signal);
  pthread_sigmask(how, &set, nullptr);
}

#if defined(__GLIBC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// Called before the constructors of all libraries; a sanitizer is not ready then.
[[gnu::section(".preinit_array"), gnu::used]] void (*const before_all)() = keep_signals_waiting;
#endif

}  // namespace

void keep_signals_waiting() { change_mask(SIG_BLOCK); }
void let_signals_through() { change_mask(SIG_UNBLOCK); }

void answer_signals(const char* sentence) {
  end_of_set_up = sentence;
  handle(SIGUSR1, ask_to_save);
  handle(SIGPIPE, SIG_IGN);
  handle_all(end_set_up, 0);
  let_signals_through();
}

const std::atomic<bool>& stop_on_signal() {
  handle_all(ask_to_stop, static_cast<int>(SA_RESETHAND));
  return stop;
}

bool has_stopped() { return stop; }

std::atomic<bool>& save_on_signal() { return save; }

const std::atomic<bool>& hold_signals() {
  is_held = true;
  handle_all(ask_to_stop, 0);
  return leave;
}

}  // namespace seiche::cli
