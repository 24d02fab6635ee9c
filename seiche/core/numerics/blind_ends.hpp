// Where quadratures of a step do not look.
#pragma once

#include <array>

namespace seiche {

// Kronrod's 15 points see a jump between any two of them, and none between the outermost and an end of the step. There
// a smooth function is what the polynomial of degree 14 through the points makes of it; what it is beyond that, times
// `width` of the step, is a part of its integral that nobody has seen.
struct BlindEnds {
  static constexpr std::size_t count = 15;
  static constexpr double width = 0.0042723144395937;  // (1 − the outermost point)/2
  std::array<double, count> points;                    // on [0, 1]
  std::array<double, count> to_begin, to_end;          // the polynomial at 0 and 1, as sums of its values at the points
};

const BlindEnds& blind_ends();

}  // namespace seiche
