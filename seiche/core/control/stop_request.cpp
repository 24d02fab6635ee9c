#include <seiche/core/control/stop_request.hpp>

#include <chrono>
#include <optional>
#include <utility>

namespace seiche {
namespace {

using Clock = StopRequest::Clock;

thread_local const std::atomic<bool>* asked = nullptr;
thread_local Clock::time_point deadline = StopRequest::never;
thread_local std::optional<Clock::time_point> seen;  // when the flag was first found set

}  // namespace

StopRequest::StopRequest(const std::atomic<bool>* stop, Clock::time_point until)
    : before_(std::exchange(asked, stop)), deadline_before_(std::exchange(deadline, until)) {
  seen.reset();
}
StopRequest::~StopRequest() {
  asked = before_;
  deadline = deadline_before_;
  seen.reset();
}

void end_if_asked() {
  const bool is_asked = asked != nullptr && asked->load(std::memory_order_relaxed);
  if (!is_asked && deadline == StopRequest::never) return;
  constexpr auto patience = std::chrono::milliseconds(500);
  const Clock::time_point now = Clock::now();
  if (!is_asked && now < deadline) return;
  if (!seen) seen = now;
  if (now - *seen > patience) throw Stopped();
}

}  // namespace seiche
