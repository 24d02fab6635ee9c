// To be loaded before a program (LD_PRELOAD): the n-th write to a file that is no standard stream fails, as on a disk
// that is full or broken. By the environment: SEICHE_FAIL_AT is n, from 1; SEICHE_FAIL_WITH the number of the error, or
// 0 for a write that says it wrote nothing; with SEICHE_FAIL_ONCE the writes behind it succeed again.
//
// With SEICHE_KILL_AT the program is killed before the n-th call that changes something on a disk: any write to a file,
// fdatasync, fsync, ftruncate, renameat and unlinkat. With SEICHE_SIGNAL_AT it gets the signal SEICHE_SIGNAL there, and
// goes on; with SEICHE_SIGNAL alone it gets it as the first thing in its main, when it asks how signals are handled.
//
// In the file SEICHE_SYNC_LOG each fdatasync, fsync and renameat leaves a line: "sync final.txt.partial", "sync out",
// "name final.txt", and so does the signal: "sent 15". With SEICHE_FAIL_SYNC every fdatasync fails with that error.
#include <dlfcn.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

long number(const char* name) {
  const char* const text = std::getenv(name);
  return text != nullptr ? std::atol(text) : 0;
}

void log(const char* what, std::string name) {
  const char* const file = std::getenv("SEICHE_SYNC_LOG");
  if (file == nullptr) return;
  name.erase(0, name.rfind('/') + 1);
  if (std::FILE* const out = std::fopen(file, "a")) {
    std::fprintf(out, "%s %s\n", what, name.c_str());
    std::fclose(out);
  }
}

void send(int signal) {
  log("sent", std::to_string(signal));
  std::raise(signal);
}

void count_call() {
  static const long kill_at = number("SEICHE_KILL_AT"), signal_at = number("SEICHE_SIGNAL_AT");
  static long count = 0;
  ++count;
  if (count == kill_at) std::raise(SIGKILL);
  if (count == signal_at) send(static_cast<int>(number("SEICHE_SIGNAL")));
}

std::string name_of(int file) {
  std::string name(4096, '\0');
  const ssize_t size = ::readlink(("/proc/self/fd/" + std::to_string(file)).c_str(), name.data(), name.size());
  name.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return name;
}

// Does this one fail? Then errno says why.
bool fails(int file) {
  if (file > STDERR_FILENO) count_call();
  static const long at = number("SEICHE_FAIL_AT"), with = number("SEICHE_FAIL_WITH");
  static const bool once = std::getenv("SEICHE_FAIL_ONCE") != nullptr;
  static long count = 0;
  if (file <= STDERR_FILENO || at == 0) return false;
  ++count;
  if (once ? count != at : count < at) return false;
  errno = static_cast<int>(with);
  return true;
}

ssize_t nothing_written() { return errno == 0 ? 0 : -1; }

}  // namespace

extern "C" {

sighandler_t signal(int number_of, sighandler_t handler) {
  static auto* const next = real<sighandler_t(int, sighandler_t)>("signal");
  static bool is_first = true;
  if (is_first && number("SEICHE_SIGNAL") != 0 && number("SEICHE_SIGNAL_AT") == 0)
    send(static_cast<int>(number("SEICHE_SIGNAL")));
  is_first = false;
  return next(number_of, handler);
}

ssize_t write(int file, const void* from, size_t size) {
  static auto* const next = real<ssize_t(int, const void*, size_t)>("write");
  return fails(file) ? nothing_written() : next(file, from, size);
}

ssize_t pwrite(int file, const void* from, size_t size, off_t at) {
  static auto* const next = real<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  return fails(file) ? nothing_written() : next(file, from, size, at);
}

ssize_t pwrite64(int file, const void* from, size_t size, off64_t at) {
  static auto* const next = real<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  return fails(file) ? nothing_written() : next(file, from, size, at);
}

ssize_t writev(int file, const iovec* from, int count) {
  static auto* const next = real<ssize_t(int, const iovec*, int)>("writev");
  return fails(file) ? nothing_written() : next(file, from, count);
}

ssize_t pwritev(int file, const iovec* from, int count, off_t at) {
  static auto* const next = real<ssize_t(int, const iovec*, int, off_t)>("pwritev");
  return fails(file) ? nothing_written() : next(file, from, count, at);
}

size_t fwrite(const void* from, size_t size, size_t count, FILE* file) {
  static auto* const next = real<size_t(const void*, size_t, size_t, FILE*)>("fwrite");
  return fails(fileno(file)) ? 0 : next(from, size, count, file);
}

int fdatasync(int file) {
  static auto* const next = real<int(int)>("fdatasync");
  count_call();
  log("sync", name_of(file));
  if (const long reason = number("SEICHE_FAIL_SYNC"); reason != 0) {
    errno = static_cast<int>(reason);
    return -1;
  }
  return next(file);
}

int fsync(int file) {
  static auto* const next = real<int(int)>("fsync");
  count_call();
  log("sync", name_of(file));
  return next(file);
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  static auto* const next = real<int(int, const char*, int, const char*)>("renameat");
  count_call();
  log("name", to);
  return next(from_folder, from, to_folder, to);
}

int unlinkat(int folder, const char* name, int flags) {
  static auto* const next = real<int(int, const char*, int)>("unlinkat");
  count_call();
  return next(folder, name, flags);
}

int ftruncate(int file, off_t size) {
  static auto* const next = real<int(int, off_t)>("ftruncate");
  count_call();
  return next(file, size);
}

int ftruncate64(int file, off64_t size) {
  static auto* const next = real<int(int, off64_t)>("ftruncate64");
  count_call();
  return next(file, size);
}
}
