// To be loaded before a program (LD_PRELOAD): the time of the day is eight years late at one look and early at the
// next, as when the clock is set. What counts seconds goes on as before.
#include <dlfcn.h>
#include <sys/time.h>

#include <atomic>
#include <ctime>

namespace {

time_t jump() {
  static std::atomic<int> looks = 0;
  constexpr time_t years = 3000 * 86400;
  return ++looks % 2 == 1 ? -years : years;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, struct timespec* at) {
  static auto* const original = real<int(clockid_t, struct timespec*)>("clock_gettime");
  const int result = original(clock, at);
  if (clock == CLOCK_REALTIME) at->tv_sec += jump();
  return result;
}

int gettimeofday(struct timeval* at, void* zone) {
  static auto* const original = real<int(struct timeval*, void*)>("gettimeofday");
  const int result = original(at, zone);
  at->tv_sec += jump();
  return result;
}

time_t time(time_t* at) {
  static auto* const original = real<time_t(time_t*)>("time");
  const time_t now = original(nullptr) + jump();
  if (at != nullptr) *at = now;
  return now;
}
}
