// When what has been recorded has to go to the disk: some seconds after it came, also where nothing else comes.
#pragma once

#include <chrono>
#include <cstdint>

namespace seiche {

// Few looks at the clock where steps are fast, since one costs as much as a small step, and one at every step where
// they are slow.
//
// For tests, the environment variable SEICHE_FLUSH_SECONDS replaces the five seconds: with 0 every row is written as
// it comes, so that chunks are written again and again before they are full. Anything but a number ≥ 0 is ignored.
class FlushClock {
 public:
  using Clock = std::chrono::steady_clock;

  // `last`: of an earlier flush.
  explicit FlushClock(Clock::time_point last = Clock::now());

  bool is_overdue() const { return Clock::now() - last_ > longest_; }
  void waits(std::int64_t n);       // something that came at step n
  bool is_overdue(std::int64_t n);  // for what waits, if anything does; asked after every step
  void flushed();                   // nothing waits

 private:
  std::chrono::duration<double> longest_;
  Clock::time_point last_;
  bool is_waiting_ = false;
  std::int64_t since_ = 0, next_look_ = 0;
};

}  // namespace seiche
