// A run that is asked to stop ends between two steps. Where one step takes long, the loops inside it ask too.
#pragma once

#include <seiche/core/base/error.hpp>

#include <atomic>

namespace seiche {

// Thrown inside a step, which then has no result.
class Stopped : public Error {
 public:
  Stopped() : Error("stopped inside a step") {}
};

// As long as it lives, `stop` is what end_if_asked looks at on this thread; null: nothing.
class StopRequest {
 public:
  explicit StopRequest(const std::atomic<bool>* stop);
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

 private:
  const std::atomic<bool>* before_;
};

// Throws Stopped where the flag has been set for half a second: a step that is nearly done comes to its end. Costs two
// loads as long as it is not set.
void end_if_asked();

}  // namespace seiche
