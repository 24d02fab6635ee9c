// W(u) = 1 − cos u: a potential that is no polynomial, as a user would write it.
#pragma once

#include <cmath>

namespace seiche::test {

struct Cosine {
  double value(double u) const { return 2 * std::sin(u / 2) * std::sin(u / 2); }
  double slope(double u) const { return std::sin(u); }
  double mean_slope(double a, double b) const {  // sin((a+b)/2) · sinc((b−a)/2)
    const double half = (b - a) / 2;
    const double sinc = std::abs(half) < 1e-4 ? 1 - half * half / 6 : std::sin(half) / half;
    return std::sin((a + b) / 2) * sinc;
  }
  bool grows_outward() const { return false; }
};

}  // namespace seiche::test
