#include <seiche/core/numerics/gauss_rule.hpp>

#include <boost/math/special_functions/legendre.hpp>

namespace seiche {

std::vector<GaussNode> gauss_rule(int n) {
  std::vector<GaussNode> rule(static_cast<std::size_t>(n));
  if (n == 0) return rule;
  const std::vector<long double> zeros = boost::math::legendre_p_zeros<long double>(n);  // those ≥ 0, increasing
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    const long double x = zeros[i];
    const long double slope = boost::math::legendre_p_prime<long double>(n, x);
    const auto weight = static_cast<double>(1 / ((1 - x * x) * slope * slope));
    rule[zeros.size() - 1 - i] = {static_cast<double>((1 - x) / 2), weight};
    rule[rule.size() - zeros.size() + i] = {static_cast<double>((1 + x) / 2), weight};
  }
  return rule;
}

}  // namespace seiche
