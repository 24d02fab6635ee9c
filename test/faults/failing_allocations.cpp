// To be loaded before a program (LD_PRELOAD): from main on, the n-th allocation of memory fails, as where there is no
// more of it. By the environment: SEICHE_FAIL_ALLOCATION is n, from 1; with SEICHE_FAIL_FOREVER all behind it fail too;
// SEICHE_ALLOCATIONS names a file that gets the number of allocations when the program ends.
#include <dlfcn.h>
#include <unistd.h>

#include <fcntl.h>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>

// The allocator of the C library, under the names that it keeps for this; dlsym would allocate.
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* from, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
}

namespace {

// All zero before the first constructor: the loader allocates long before main.
std::atomic<bool> is_counting;
std::atomic<long> allocations;
long failing_one;
bool fails_forever;

using Main = int (*)(int, char**, char**);
Main real_main;

bool fails() {
  if (!is_counting.load(std::memory_order_relaxed)) return false;
  const long n = ++allocations;
  if (failing_one == 0 || (fails_forever ? n < failing_one : n != failing_one)) return false;
  errno = ENOMEM;
  return true;
}

void tell_count() {
  is_counting = false;
  const char* const name = std::getenv("SEICHE_ALLOCATIONS");
  if (name == nullptr) return;
  const int file = open(name, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0) return;
  char digits[24];
  int at = sizeof(digits);
  for (long n = allocations; at > 0 && (n > 0 || at == sizeof(digits)); n /= 10)
    digits[--at] = static_cast<char>('0' + n % 10);
  [[maybe_unused]] const ssize_t written = write(file, digits + at, sizeof(digits) - static_cast<size_t>(at));
  close(file);
}

int counted_main(int count, char** values, char** environment) {
  const char* const n = std::getenv("SEICHE_FAIL_ALLOCATION");
  failing_one = n != nullptr ? std::atol(n) : 0;
  fails_forever = std::getenv("SEICHE_FAIL_FOREVER") != nullptr;
  std::atexit(tell_count);
  is_counting = true;
  return real_main(count, values, environment);
}

}  // namespace

extern "C" {

int __libc_start_main(Main main, int count, char** values, void (*init)(), void (*fini)(), void (*loader_fini)(),
                      void* stack_end) {
  using Start = int(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  real_main = main;
  auto* const next = reinterpret_cast<Start*>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return next(counted_main, count, values, init, fini, loader_fini, stack_end);
}

void* malloc(size_t size) { return fails() ? nullptr : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return fails() ? nullptr : __libc_calloc(count, size); }
void* realloc(void* from, size_t size) { return fails() ? nullptr : __libc_realloc(from, size); }
void* memalign(size_t alignment, size_t size) { return fails() ? nullptr : __libc_memalign(alignment, size); }
void* aligned_alloc(size_t alignment, size_t size) { return fails() ? nullptr : __libc_memalign(alignment, size); }

int posix_memalign(void** out, size_t alignment, size_t size) {
  if (fails()) return ENOMEM;
  *out = __libc_memalign(alignment, size);
  return *out == nullptr ? ENOMEM : 0;
}
}
