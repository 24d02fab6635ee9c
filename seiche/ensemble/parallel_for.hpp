// A loop whose turns are independent of each other, on several threads.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace seiche {

// What the first failing turn throws is thrown here, after all threads have ended.
template <class Turn>
void parallel_for(Index count, int threads, const Turn& turn) {
  std::atomic<Index> next = 0;
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto work = [&] {
    for (Index i = next++; i < count; i = next++) {
      try {
        turn(i);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!thrown) thrown = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (Index i = 1; i < std::min<Index>(threads, count); ++i) others.emplace_back(work);
    work();
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace seiche
