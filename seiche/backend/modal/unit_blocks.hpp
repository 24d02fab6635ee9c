// Slots of a field in blocks for loops that add up, unit by unit.
#pragma once

#include <seiche/core/simd/parallel.hpp>
#include <seiche/core/space.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace seiche {

class UnitBlocks {
 public:
  // Of `field`, in blocks of at most `most` slots.
  UnitBlocks(const Space::Field& field, Index most)
      : units_(field.units), is_one_block_(field.units.whole().count() == 1 && field.of <= most) {
    for (Index unit = 0; unit < field.units.count(); ++unit) {
      for (Index begin = field.begin(unit); begin < field.end(unit); begin += most)
        append({unit, begin, std::min(begin + most, field.end(unit))}, most);
    }
  }

  // Of body(begin, end, sums), which is called on several threads and writes as many sums as there are totals: the same
  // for every number of threads and processes.
  template <class Body>
  void add(const Space& space, int threads, std::span<double> totals, const Body& body) const {
    if (is_one_block_) {  // which one process holds, and the others none
      std::fill(totals.begin(), totals.end(), 0.0);
      if (!blocks_.empty()) body(blocks_[0].begin, blocks_[0].end, totals);
      return space.sum(totals);
    }
    const std::size_t k = totals.size();
    parts_.resize(blocks_.size() * k);
    sums_.assign(static_cast<std::size_t>(units_.count()) * k, 0.0);
    for_blocks(static_cast<Index>(shares_.size()), threads, [&](Index share) {
      const auto [first, last] = shares_[static_cast<std::size_t>(share)];
      for (std::size_t at = first; at < last; ++at)
        body(blocks_[at].begin, blocks_[at].end, std::span(parts_).subspan(at * k, k));
    });
    for (std::size_t at = 0; at < blocks_.size(); ++at)
      for (std::size_t i = 0; i < k; ++i)
        sums_[static_cast<std::size_t>(blocks_[at].unit) * k + i] += parts_[at * k + i];
    space.add_units(units_, sums_, totals);
  }

 private:
  struct Block {
    Index unit, begin, end;
  };
  struct Share {
    std::size_t first, last;
  };
  void append(const Block& block, Index most) {
    blocks_.push_back(block);
    if (shares_.empty() || block.end - blocks_[shares_.back().first].begin > most)
      shares_.push_back({blocks_.size() - 1, blocks_.size()});
    else
      shares_.back().last = blocks_.size();
  }

  Units units_;
  bool is_one_block_;  // the field as a whole, in all processes
  std::vector<Block> blocks_;
  std::vector<Share> shares_;                 // blocks of one call on a thread, up to `most` slots
  mutable std::vector<double> parts_, sums_;  // scratch
};

}  // namespace seiche
