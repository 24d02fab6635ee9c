#include <seiche/backend/sparse/pade_poles.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

using Long = long double;
using Coefficients = std::vector<Long>;

// c_j of D(x) = Σ c_j (−x)ʲ, c_j = (2q−j)! q! / ((2q)! j! (q−j)!), signs included.
Coefficients denominator(int q) {
  Coefficients c(static_cast<std::size_t>(q) + 1);
  c[0] = 1;
  for (int j = 0; j < q; ++j)
    c[static_cast<std::size_t>(j) + 1] =
        -c[static_cast<std::size_t>(j)] * static_cast<Long>(q - j) / static_cast<Long>((2 * q - j) * (j + 1));
  return c;
}

// Eigenvalues of the companion matrix have lost digits by q = 12; Newton in long double brings them back.
std::complex<double> polished(const Coefficients& c, std::complex<double> start) {
  std::complex<Long> x = start;
  for (int i = 0; i < 6; ++i) {
    std::complex<Long> value = 0;
    std::complex<Long> slope = 0;
    for (std::size_t j = c.size(); j-- > 0;) {
      slope = slope * x + value;
      value = value * x + c[j];
    }
    x -= value / slope;
  }
  return std::complex<double>(static_cast<double>(x.real()), static_cast<double>(x.imag()));
}

double log_error(int q, double x) {
  return 2 * std::lgamma(q + 1.0) - std::lgamma(2 * q + 1.0) - std::lgamma(2 * q + 2.0) + (2 * q + 1) * std::log(x);
}

}  // namespace

std::vector<std::complex<double>> pade_poles(int q) {
  const Coefficients c = denominator(q);
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(q, q);
  companion.diagonal(-1).setOnes();
  for (int j = 0; j < q; ++j) companion(j, q - 1) = static_cast<double>(-c[static_cast<std::size_t>(j)] / c.back());
  const Eigen::VectorXcd roots = companion.eigenvalues();
  std::vector<std::complex<double>> poles;
  for (const std::complex<double>& root : roots)
    if (root.imag() > 1e-6 * std::abs(root)) poles.push_back(polished(c, root));
  if (q % 2 == 1) {
    const auto real = std::min_element(roots.begin(), roots.end(), [](const auto& a, const auto& b) {
      return std::abs(a.imag()) < std::abs(b.imag());
    });
    poles.emplace_back(polished(c, real->real()).real(), 0.0);
  }
  return poles;
}

PadePlan plan_pade(double radius, double tolerance) {
  PadePlan best{1, 1};
  double fewest = std::numeric_limits<double>::infinity();
  for (int q = 1; q <= max_pade_degree; ++q) {
    // steps · error(q, radius / steps) ≤ tolerance, solved for the number of steps
    const double excess = radius > 0 ? log_error(q, radius) - std::log(tolerance) : -1;
    const double steps = std::max(1.0, std::ceil(std::exp(excess / (2 * q))));
    const double solves = steps * (q + q % 2);  // a complex solve costs two real ones
    if (solves < fewest) {
      fewest = solves;
      best = {q, static_cast<int>(std::min(steps, 1e9))};
    }
  }
  return best;
}

PadePlan plan_exponential(double radius, const SparseOptions& options) {
  constexpr double tolerance = 1e-14;
  if (options.pade_degree > 0) return {options.pade_degree, 1};
  return plan_pade(radius, tolerance);
}

}  // namespace seiche
