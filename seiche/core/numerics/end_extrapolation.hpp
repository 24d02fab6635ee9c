// Extrapolation of an integrand to both ends of a step, between which and its outermost node no quadrature samples it.
#pragma once

#include <array>

namespace seiche {

// Kronrod's 15 points show a jump between any two of them, and none between the outermost and an end of the step. There
// a smooth function is what the polynomial of degree 14 through the points makes of it; by how much the value at the
// end differs from that, times `width` of the step, estimates the error of its integral.
struct EndExtrapolation {
  static constexpr std::size_t count = 15;
  static constexpr double width = 0.0042723144395937;  // (1 − the outermost point)/2
  std::array<double, count> points;                    // on [0, 1]
  std::array<double, count> to_begin, to_end;          // the polynomial at 0 and 1, as sums of its values at the points
};

const EndExtrapolation& end_extrapolation();

}  // namespace seiche
