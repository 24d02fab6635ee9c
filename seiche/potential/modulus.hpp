// V(u) = Σ_j W(|ψ_j|²) of a complex field ψ = p + iq, held as two real ones: u = (p, q).
#pragma once

#include <seiche/core/potential.hpp>
#include <seiche/potential/loops.hpp>
#include <seiche/potential/polynomial.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace seiche {

// The mean gradient is that of Delfour, Fortin and Payne (1981), with ρ = |ψ|²,
//   (W(ρ_b) − W(ρ_a)) / (ρ_b − ρ_a) · (ψ_a + ψ_b).
// It keeps the contract as the average along the segment does, and is a real multiple of the mean of ψ at every point:
// with it Crank–Nicolson keeps Σ|ψ|² as well as H, which the average does not.
template <PointPotential W>
class ModulusPotential final : public PointwisePotential {
 public:
  explicit ModulusPotential(W w) : w_(w) {}

  Index fields() const override { return 2; }
  bool is_pointwise() const override { return true; }

  double value(std::span<const double> u) const override {
    return sum_points(u.size() / 2, [&](std::size_t j) { return w_.value(density(u, j)); });
  }

  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override {
    return sum_points_and_sizes(
        u.size() / 2, [&](std::size_t j) { return w_.value(density(u, j)); },
        [&](std::size_t j, double value) { return size_of(w_, density(u, j), value); });
  }

  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override {
    const std::size_t n = u.size() / 2;
    return sum_points(n, [&](std::size_t j) {
      const double rho = density(u, j);
      const double slope = 2 * w_.slope(rho);
      gradient[j] = slope * u[j];
      gradient[n + j] = slope * u[n + j];
      return w_.value(rho);
    });
  }

  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override {
    const std::size_t n = a.size() / 2;
    for (std::size_t j = 0; j < n; ++j) {
      const double slope = w_.mean_slope(density(a, j), density(b, j));
      mean[j] = slope * (a[j] + b[j]);
      mean[n + j] = slope * (a[n + j] + b[n + j]);
    }
  }

  int degree() const override {
    if constexpr (IsPolynomial<W>) return 2 * w_.degree();
    return 0;
  }

  // |ψ + xφ|² = ρ + 2σx + τx², put into W by Horner's rule.
  void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const override {
    if constexpr (IsPolynomial<W>) {
      const std::size_t n = p.size() / 2;
      sum_coefficients(n, coefficients, [&](std::size_t j, double* into) {
        const double sigma = p[j] * q[j] + p[n + j] * q[n + j];
        add_composition(density(p, j), 2 * sigma, density(q, j), into);
      });
    } else {
      std::fill(coefficients.begin(), coefficients.end(), 0.0);
    }
  }

  int homogeneity() const override { return 2 * homogeneity_of(w_); }
  bool grows_outward() const override { return w_.grows_outward(); }  // ψ·∇V = 2ρW'(ρ)

 private:
  static double density(std::span<const double> u, std::size_t j) { return square(u[j]) + square(u[u.size() / 2 + j]); }

  void add_composition(double c0, double c1, double c2, double* out) const {
    std::array<double, 2 * W::most + 1> sum{};
    const auto degree = static_cast<std::size_t>(w_.degree());
    for (std::size_t i = degree + 1; i-- > 0;) {
      for (std::size_t k = 2 * degree + 1; k-- > 0;)
        sum[k] = c0 * sum[k] + (k >= 1 ? c1 * sum[k - 1] : 0.0) + (k >= 2 ? c2 * sum[k - 2] : 0.0);
      sum[0] += w_.c[i];
    }
    for (std::size_t k = 0; k <= 2 * degree; ++k) out[k] += sum[k];
  }

  W w_;
};

}  // namespace seiche
