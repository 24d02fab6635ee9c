#include <bench/scaling/sizes.hpp>

namespace seiche::bench {

double growth_exponent(const std::vector<SizeCost>& costs, double Floor::*time, Index smallest) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const SizeCost& cost : costs) {
    if (cost.points < smallest) continue;
    const double a = std::log(static_cast<double>(cost.points) * cost.levels());
    const double b = std::log(cost.floor.*time);
    n += 1;
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace seiche::bench
