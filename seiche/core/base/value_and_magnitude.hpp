// Sums that know how large their round-off may be.
#pragma once

#include <cmath>

namespace seiche {

struct ValueAndMagnitude {
  double value = 0.0;
  double magnitude = 0.0;  // the same sum with the sizes of its terms: the scale of round-off in the value

  ValueAndMagnitude& operator+=(double term) {
    value += term;
    magnitude += std::abs(term);
    return *this;
  }
  ValueAndMagnitude& operator+=(const ValueAndMagnitude& other) {
    value += other.value;
    magnitude += other.magnitude;
    return *this;
  }
};

}  // namespace seiche
