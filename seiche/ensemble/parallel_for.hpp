// A loop whose turns are independent of each other and may throw, on the threads that the loops of a step use.
#pragma once

#include <seiche/core/simd/parallel.hpp>

#include <atomic>
#include <exception>
#include <mutex>

namespace seiche {

// What the first failing turn throws is thrown here, when those that had begun are done. Loops inside a turn are its
// own, and need no threads.
template <class Turn>
void parallel_for(Index count, int threads, const Turn& turn) {
  std::atomic<bool> has_failed = false;
  std::mutex mutex;
  std::exception_ptr thrown;
  for_blocks(count, threads, [&](Index i) {
    if (has_failed) return;
    try {
      turn(i);
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!thrown) thrown = std::current_exception();
      has_failed = true;
    }
  });
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace seiche
