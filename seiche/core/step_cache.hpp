// What is computed once for each step size.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace seiche {

// For how many step sizes propagators, flows and tables of φ-functions are kept, of states with so many components:
// sixteen, or as many as take some hundreds of megabytes.
inline std::size_t cached_step_sizes(std::ptrdiff_t size) {
  return static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>((std::ptrdiff_t{1} << 20) / std::max<std::ptrdiff_t>(size, 1), 3, 16));
}

// The least recently used entry goes first.
template <class T>
class StepCache {
 public:
  explicit StepCache(std::size_t capacity) : capacity_(capacity) {}

  // make(): a std::unique_ptr<T>, asked for where h is new.
  template <class Make>
  T& at(double h, const Make& make) {
    if (!entries_.empty() && entries_.front().first == h) return *entries_.front().second;
    return find_or_make(h, make);
  }

 private:
  template <class Make>
  [[gnu::noinline]] T& find_or_make(double h, const Make& make) {  // apart, so that `at` saves no registers
    const auto found = std::find_if(entries_.begin(), entries_.end(), [h](const auto& e) { return e.first == h; });
    if (found == entries_.end()) {
      auto made = make();
      if (entries_.size() == capacity_) entries_.pop_back();
      entries_.insert(entries_.begin(), {h, std::move(made)});
    } else {
      std::rotate(entries_.begin(), found, found + 1);
    }
    return *entries_.front().second;
  }

  std::size_t capacity_;
  std::vector<std::pair<double, std::unique_ptr<T>>> entries_;
};

}  // namespace seiche
