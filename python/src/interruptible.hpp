// Work that asks a flag, on a thread beside the one that Python runs on.
#pragma once

#include "callbacks.hpp"

#include <atomic>
#include <chrono>
#include <future>

namespace seiche::python {

// However the wait ends, before the thread is waited for.
struct StopsAtEnd {
  std::atomic<bool>& stop;
  ~StopsAtEnd() { stop = true; }
};

// work() on a thread of its own, while this one calls on_signal() at each Ctrl-C, and meanwhile() all the time.
template <class Work, class OnSignal, class Meanwhile>
auto beside_signals(std::atomic<bool>& stop, const Work& work, const OnSignal& on_signal, const Meanwhile& meanwhile) {
  return without_gil([&] {
    auto result = std::async(std::launch::async, work);
    const StopsAtEnd stops{stop};
    SignalCheck signals;
    while (result.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
      if (signals.is_new()) on_signal();
      meanwhile();
    }
    return result.get();
  });
}

// study(stop), which Ctrl-C ends without a result.
template <class Study>
auto interruptible(const Study& study) {
  std::atomic<bool> stop = false;
  return beside_signals(
      stop, [&] { return study(&stop); }, [] { throw Error("interrupted"); }, [] {});
}

}  // namespace seiche::python
