// GiNaC counts references without locks: threads that read or differentiate formulas do so one after the other.
#pragma once

#include <mutex>

namespace seiche {

[[nodiscard]] inline std::unique_lock<std::recursive_mutex> algebra_lock() {
  static std::recursive_mutex mutex;
  return std::unique_lock(mutex);
}

}  // namespace seiche
