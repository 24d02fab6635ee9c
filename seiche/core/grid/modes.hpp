// The modes of a grid, in the order in which modal coordinates hold them.
#pragma once

#include <seiche/core/grid/grid.hpp>

#include <array>

namespace seiche {

// One mode: along axis a its phase advances by 2πk / period from point to point.
struct Mode {
  std::array<Index, 3> k{};
  std::array<Index, 3> period{1, 1, 1};
};

// Periodic along every axis: complex exponentials, ⌊N/2⌋ + 1 of them along the last axis (the others follow by
// conjugation), each a pair of slots (Re, Im). Otherwise: products of cosines and sines, one real slot each.
class Modes {
 public:
  explicit Modes(const Grid& grid);
  Index count() const { return count_; }
  bool are_pairs() const { return pairs_; }
  Index slots() const { return pairs_ ? 2 * count_ : count_; }
  Mode operator[](Index index) const;

 private:
  Mode first_;  // periods
  std::array<Index, 3> sizes_{1, 1, 1};
  std::array<Boundary, 3> boundaries_{};
  Index dimension_;
  bool pairs_;
  Index count_ = 1;
};

}  // namespace seiche
