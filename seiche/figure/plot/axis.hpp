// One axis: its range, linear or logarithmic, and ticks that suit what it shows. gnuplot's own would label a span of
// less than a decade with one number, and step sizes 2⁻ⁿ with none.
#pragma once

#include <seiche/figure/plot/linear_ticks.hpp>

#include <span>
#include <string>
#include <vector>

namespace seiche {

struct Axis {
  bool logarithmic = true;
  double low = 0.1, high = 1.0;
  std::string ticks;        // the argument of gnuplot's `set xtics`
  bool empty = false;       // no value can be shown: low and high are arbitrary
  LinearTicks linear = {};  // the ticks of a linear axis, and what its label says of them

  // From 0 at low to 1 at high.
  double place(double value) const;
  bool shows(double value) const;  // finite, and positive on a logarithmic axis
};

// Around the values that can be shown, with a margin at both ends as a part of the span.
Axis fitted_axis(bool logarithmic, std::span<const double> values, double margin = 0.06);
Axis axis_between(bool logarithmic, double low, double high);
// A logarithmic one with a line "0" below its smallest value, where `zero` is drawn.
struct AxisWithZero {
  Axis axis = {};
  double zero = 0.0;
};
AxisWithZero with_zero_line(const Axis& axis);
// From zero to `high`, or to a round number that lies only a little beyond.
Axis axis_from_zero(double high);
// 1, 2 or 5 times a power of ten, so that a linear axis of this length has about so many ticks.
double tick_step(double length, int ticks);
// Labels 2⁻ⁿ if all values are powers of two, otherwise as fitted_axis.
Axis step_size_axis(std::span<const double> step_sizes);

bool all_powers_of_two(std::span<const double> values);

}  // namespace seiche
