#include <seiche/core/base/vector.hpp>
#include <seiche/ensemble/statistics.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

double quantile(std::span<const double> sorted, double p) {
  const double place = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 == sorted.size()) return sorted[below];
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[below + 1] - sorted[below]);
}

}  // namespace

Statistics statistics(std::span<double> values) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return {none, none, none, none, none, none, none};
  std::sort(values.begin(), values.end());  // sums taken in sorted order do not depend on the order of the members
  const auto count = static_cast<double>(values.size());
  double mean = 0;
  for (const double v : values) mean += v / count;
  double squares = 0;
  for (const double v : values) squares += square(v - mean);
  return {.mean = mean,
          .standard_deviation = values.size() > 1 ? std::sqrt(squares / (count - 1)) : 0.0,
          .minimum = values.front(),
          .low = quantile(values, 0.05),
          .median = quantile(values, 0.5),
          .high = quantile(values, 0.95),
          .maximum = values.back()};
}

}  // namespace seiche
