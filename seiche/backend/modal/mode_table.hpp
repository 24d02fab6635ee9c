// Sums over a few vectors with factors of their own for each mode, in one pass.
#pragma once

#include <seiche/backend/modal/mode_arrays.hpp>
#include <seiche/backend/modal/unit_blocks.hpp>
#include <seiche/core/simd/cache_lines.hpp>
#include <seiche/core/simd/lanes.hpp>

#include <complex>
#include <span>

namespace seiche {

// So many factors per mode in the order in which a pass reads them: eight slots are taken at a time, and their factors
// lie side by side. One stream through memory, however many factors there are.
class ModeFactors {
 public:
  ModeFactors(ModeLayout layout, Index modes, Index per_mode);
  void set(Index mode, Index which, std::complex<double> factor);
  // Of eight modes from `first` on, a multiple of eight; what lies beyond the last mode is ignored. Imaginary parts
  // where factors are complex.
  [[gnu::always_inline]] inline void set_eight(Index first, Index which, const Lanes& re, const Lanes& im);

  ModeLayout layout() const { return layout_; }
  Index slots() const { return slots_; }
  Index chunks() const { return groups_of_lanes(slots_); }
  Index stride() const { return lane_count / slots_per_mode(layout_) * factors_per_mode(layout_); }
  const double* of_chunk(Index chunk) const { return factors_.data() + chunk * per_mode_ * stride(); }

 private:
  ModeLayout layout_;
  Index slots_, per_mode_;
  CacheLines factors_;
};

void ModeFactors::set_eight(Index first, Index which, const Lanes& re, const Lanes& im) {
  if (layout_ == ModeLayout::singles) {
    store<Lanes>(factors_.data() + (first / lane_count * per_mode_ + which) * lane_count, re);
    return;
  }
  const Index chunk = first * 2 / lane_count;  // and the one after it
  const bool both = chunk + 1 < chunks();
  double* at = factors_.data() + (chunk * per_mode_ + which) * stride();
  double* after = at + per_mode_ * stride();
  if (layout_ == ModeLayout::real_pairs) {
    store<HalfLanes>(at, __builtin_shufflevector(re, re, 0, 1, 2, 3));
    if (both) store<HalfLanes>(after, __builtin_shufflevector(re, re, 4, 5, 6, 7));
  } else {
    store<Lanes>(at, __builtin_shufflevector(re, im, 0, 8, 1, 9, 2, 10, 3, 11));
    if (both) store<Lanes>(after, __builtin_shufflevector(re, im, 4, 12, 5, 13, 6, 14, 7, 15));
  }
}

// Inputs and outputs are the slots of one field each.
class ModeTable {
 public:
  ModeTable(ModeLayout layout, Index modes, Index rows, Index columns);
  void set(Index mode, Index row, Index column, std::complex<double> factor) {
    factors_.set(mode, row * columns_ + column, factor);
  }
  [[gnu::always_inline]] inline void set_eight(Index first, Index row, Index column, const Lanes& re, const Lanes& im) {
    factors_.set_eight(first, row * columns_ + column, re, im);
  }
  // out[i] ← Σ_j factor(i, j) · in[j]; an output may be an input.
  void apply(std::span<const double* const> in, std::span<double* const> out, int threads) const;

 private:
  Index columns_;
  ModeFactors factors_;
  // apply for the chunks first … last − 1, by the loop for this layout and number of columns.
  void (*sum_rows_)(const ModeFactors& factors, std::span<const double* const> in, std::span<double* const> out,
                    Index first, Index last) = nullptr;
};

// Hermitian forms, several of the same inputs.
class ModeForms {
 public:
  // `space` outlives it.
  ModeForms(ModeLayout layout, Index modes, Index forms, Index columns, const Space& space);
  // i ≤ j: the factor of (j, i) is its conjugate.
  void set(Index mode, Index form, Index i, Index j, std::complex<double> factor);
  [[gnu::always_inline]] inline void set_eight(Index first, Index form, Index i, Index j, const Lanes& re,
                                               const Lanes& im) {
    const double sides = i == j ? 1.0 : 2.0;
    factors_.set_eight(first, entry(form, i, j), sides * re, sides * im);
  }
  // values[l] ← Σ_modes Re Σ_ij x̄_i factor_l(i, j) x_j, over all processes
  void apply(std::span<const double* const> in, std::span<double> values, int threads) const;

 private:
  Index entry(Index form, Index i, Index j) const {
    return form * columns_ * (columns_ + 1) / 2 + i * columns_ - i * (i - 1) / 2 + (j - i);
  }

  Index columns_, forms_;
  ModeFactors factors_;
  const Space& space_;
  UnitBlocks blocks_;
};

}  // namespace seiche
