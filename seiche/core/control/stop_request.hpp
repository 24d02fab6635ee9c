// A run that is asked to stop ends between two steps. Where one step takes long, the loops inside it ask too.
#pragma once

#include <seiche/core/error.hpp>

#include <atomic>
#include <chrono>

namespace seiche {

// Thrown inside a step, which then has no result.
class Stopped : public Error {
 public:
  Stopped() : Error("stopped inside a step") {}
};

// As long as it lives, `stop` and `deadline` are what end_if_asked looks at on this thread; null: nothing.
class StopRequest {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr Clock::time_point never = Clock::time_point::max();

  explicit StopRequest(const std::atomic<bool>* stop, Clock::time_point deadline = never);
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

 private:
  const std::atomic<bool>* before_;
  Clock::time_point deadline_before_;
};

// Throws Stopped where the flag has been set, or the deadline over, for half a second: a step that is nearly done comes
// to its end. Costs a few loads as long as the flag is not set, and a look at the clock where there is a deadline.
void end_if_asked();

}  // namespace seiche
