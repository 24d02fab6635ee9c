// W(u) = α(1 − cos u): pendulums and sine-Gordon.
#pragma once

#include <cmath>

namespace seiche {

struct Cosine {
  double alpha = 1.0;

  double value(double u) const {
    const double s = std::sin(u / 2);
    return 2 * alpha * s * s;
  }
  // |W| + |u W'|: what round-off in u makes of it counts too, far from 0 that is more than W.
  double size(double u) const {
    const double s = std::sin(u / 2), c = std::cos(u / 2);
    return 2 * std::abs(alpha) * (s * s + std::abs(u * s * c));
  }
  double slope(double u) const { return alpha * std::sin(u); }
  // (cos a − cos b) / (b − a) = sin((a + b)/2) · sin(d)/d with d = (b − a)/2
  double mean_slope(double a, double b) const {
    const double d = (b - a) / 2;
    const double sinc = std::abs(d) < 1e-4 ? 1 - d * d / 6 : std::sin(d) / d;
    return alpha * std::sin((a + b) / 2) * sinc;
  }
  bool grows_outward() const { return alpha == 0; }
};

}  // namespace seiche
