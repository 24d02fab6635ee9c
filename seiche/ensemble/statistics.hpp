// Statistics of one number over the members of an ensemble.
#pragma once

#include <span>

namespace seiche {

// Quantiles interpolate linearly between order statistics (type 7 of Hyndman and Fan, 1996; the default of NumPy and
// R); the standard deviation divides by the count less one. All are NaN without values; the deviation is 0 for one.
struct Statistics {
  double mean, standard_deviation, minimum, low, median, high, maximum;  // low, high: 5 % and 95 %
};

Statistics statistics(std::span<double> values);  // reorders them

}  // namespace seiche
