// One small block per mode, entry by entry: what the fused passes of the modal propagator read.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/grid/modes.hpp>
#include <seiche/core/simd/cache_lines.hpp>

#include <Eigen/Dense>

#include <complex>
#include <functional>

namespace seiche {

// How the slots of one field belong to its modes, and what a factor of a mode is.
enum class ModeLayout {
  real_pairs,     // (Re, Im) and a real factor
  complex_pairs,  // (Re, Im) and a complex factor
  singles,        // one real slot and a real factor
};

constexpr Index factors_per_mode(ModeLayout layout) { return layout == ModeLayout::complex_pairs ? 2 : 1; }
constexpr Index slots_per_mode(ModeLayout layout) { return layout == ModeLayout::singles ? 1 : 2; }

// Factors (row, column) of all modes, side by side.
class ModeArrays {
 public:
  ModeArrays(Index modes, Index rows, Index columns, ModeLayout layout)
      : columns_(columns),
        stride_(whole_lanes(modes * factors_per_mode(layout))),
        layout_(layout),
        factors_(static_cast<std::size_t>(rows * columns * stride_)) {}

  void set(Index mode, Index row, Index column, std::complex<double> c) {
    double* at = data(row, column) + mode * factors_per_mode(layout_);
    at[0] = c.real();
    if (layout_ == ModeLayout::complex_pairs) at[1] = c.imag();
  }
  const double* data(Index row, Index column) const {
    return factors_.data() + static_cast<std::size_t>((row * columns_ + column) * stride_);
  }

 private:
  double* data(Index row, Index column) {
    return factors_.data() + static_cast<std::size_t>((row * columns_ + column) * stride_);
  }

  Index columns_, stride_;
  ModeLayout layout_;
  CacheLines factors_;
};

}  // namespace seiche
