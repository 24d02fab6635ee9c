#include <seiche/output/file/flush_clock.hpp>

#include <algorithm>
#include <cstdlib>

namespace seiche {
namespace {

std::chrono::duration<double> longest_wait() {
  constexpr double usual = 5;
  const char* const given = std::getenv("SEICHE_FLUSH_SECONDS");
  if (given == nullptr) return std::chrono::duration<double>(usual);
  char* end = nullptr;
  const double seconds = std::strtod(given, &end);
  return std::chrono::duration<double>(end != given && *end == '\0' && seconds >= 0 ? seconds : usual);
}

}  // namespace

FlushClock::FlushClock(Clock::time_point last) : longest_(longest_wait()), last_(last) {}

void FlushClock::waits(std::int64_t n) {
  if (is_waiting_) return;
  is_waiting_ = true;
  since_ = n;
  next_look_ = n + 1;
}

// At most a quarter late where steps become slow.
bool FlushClock::is_overdue(std::int64_t n) {
  if (!is_waiting_ || n < next_look_) return false;
  next_look_ = n + std::max<std::int64_t>(1, (n - since_) / 4);
  return is_overdue();
}

void FlushClock::flushed() {
  is_waiting_ = false;
  last_ = Clock::now();
}

}  // namespace seiche
