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

// study(stop) on a thread of its own, while this one looks for Ctrl-C.
template <class Study>
auto interruptible(const Study& study) {
  std::atomic<bool> stop = false;
  return without_gil([&] {
    auto document = std::async(std::launch::async, [&] { return study(&stop); });
    const StopsAtEnd stops{stop};
    SignalCheck signals;
    while (document.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready)
      if (signals()) throw Error("interrupted");
    return document.get();
  });
}

}  // namespace seiche::python
