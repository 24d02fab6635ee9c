#include <seiche/core/control/stop_request.hpp>

#include <chrono>
#include <optional>
#include <utility>

namespace seiche {
namespace {

using Clock = std::chrono::steady_clock;

thread_local const std::atomic<bool>* asked = nullptr;
thread_local std::optional<Clock::time_point> seen;  // when the flag was first found set

}  // namespace

StopRequest::StopRequest(const std::atomic<bool>* stop) : before_(std::exchange(asked, stop)) { seen.reset(); }
StopRequest::~StopRequest() {
  asked = before_;
  seen.reset();
}

void end_if_asked() {
  if (asked == nullptr || !asked->load(std::memory_order_relaxed)) return;
  constexpr auto patience = std::chrono::milliseconds(500);
  const Clock::time_point now = Clock::now();
  if (!seen) seen = now;
  if (now - *seen > patience) throw Stopped();
}

}  // namespace seiche
