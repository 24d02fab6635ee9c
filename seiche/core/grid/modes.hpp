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
// conjugation), each a pair of slots (Re, Im). Otherwise: products of cosines and sines, one real slot each. Axis 1
// runs slowest where there is one, then axis 0, then axis 2: a transform along axis 0, its last, turns the two.
class Modes {
 public:
  explicit Modes(const Grid& grid);
  Index count() const { return count_; }
  bool are_pairs() const { return pairs_; }
  Index slots() const { return pairs_ ? 2 * count_ : count_; }
  Mode operator[](Index index) const;
  // Of planes along axis 1, of which this process holds a slab; one plane where there is one axis.
  const Units& units() const { return units_; }  // here
  Slab slab_of_rank(int rank) const;             // of any process
  Index plane() const { return plane_; }         // slots
  FieldPart field() const { return {slots(), units_, first_plane_ * plane_, units_.of * plane_}; }

 private:
  Mode first_;  // periods
  std::array<Index, 3> sizes_{1, 1, 1};
  std::array<Boundary, 3> boundaries_{};
  Index dimension_;
  bool pairs_;
  Rank here_;
  Units units_;
  Index plane_ = 1, first_plane_ = 0;
  Index count_ = 1;
};

}  // namespace seiche
