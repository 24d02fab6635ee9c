#include <seiche/core/linear_part.hpp>
#include <seiche/core/propagator.hpp>

#include <algorithm>

namespace seiche {

Propagators::Propagators(const LinearPart& linear, PropagatorKind kind, std::size_t capacity)
    : linear_(linear), kind_(kind), capacity_(capacity) {}

const Propagator& Propagators::at(double h) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [h](const Entry& e) { return e.h == h; });
  if (found == entries_.end()) {
    if (entries_.size() == capacity_) entries_.pop_back();
    entries_.insert(entries_.begin(), Entry{h, linear_.propagator(kind_, h)});
  } else {
    std::rotate(entries_.begin(), found, found + 1);
  }
  return *entries_.front().propagator;
}

}  // namespace seiche
