// Ticks of a linear axis whose numbers would be too long, or all alike: of very large or very small values, and of
// small differences between large ones. What the numbers leave out stands in the label of the axis: "(u − 1000) /
// 10⁻⁶".
#pragma once

#include <string>

namespace seiche {

struct LinearTicks {
  std::string ticks = "autofreq";  // the argument of gnuplot's `set xtics`; its own are good for ordinary numbers
  std::string offset = {};         // " − 1000", or nothing
  std::string power = {};          // " / 10^{−6}", or nothing
};

LinearTicks linear_ticks(double low, double high, int count = 3);  // at least so many, and up to twice as many

std::string power_text(int base, int n);  // "10^{−6}", with a minus sign as wide as a digit

// A text for gnuplot (an expression of strings), followed by what the ticks leave out.
std::string with_unit(const std::string& label, const LinearTicks& ticks);

}  // namespace seiche
