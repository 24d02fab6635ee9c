// V(u) = Σ_j W(u_j).
#pragma once

#include <seiche/core/potential.hpp>
#include <seiche/potential/polynomial.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {

template <PointPotential W>
class NodalPotential final : public PointwisePotential {
 public:
  explicit NodalPotential(W w) : w_(w) {}

  double value(std::span<const double> u) const override {
    double sum = 0;
    for (const double x : u) sum += w_.value(x);
    return sum;
  }

  double magnitude(std::span<const double> u) const override {
    double sum = 0;
    for (const double x : u) sum += std::abs(w_.value(x));
    return sum;
  }

  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override {
    double sum = 0;
    for (std::size_t j = 0; j < u.size(); ++j) {
      sum += w_.value(u[j]);
      gradient[j] = w_.slope(u[j]);
    }
    return sum;
  }

  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override {
    for (std::size_t j = 0; j < a.size(); ++j) mean[j] = w_.mean_slope(a[j], b[j]);
  }

  int degree() const override {
    if constexpr (requires { W::degree; }) return W::degree;
    return 0;
  }

  void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const override {
    std::fill(coefficients.begin(), coefficients.end(), 0.0);
    if constexpr (requires { W::degree; }) {
      for (std::size_t j = 0; j < p.size(); ++j) w_.add_along(p[j], q[j], coefficients.data());
    }
  }

  bool grows_outward() const override { return w_.grows_outward(); }

 private:
  W w_;
};

}  // namespace seiche
