// V(u) = Σ_j W_bond(u_{j+1} − u_j) + Σ_j W_ground(u_j): a chain whose masses are tied to each other and to the ground.
#pragma once

#include <seiche/potential/bond.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {

// Ends as in BondPotential.
template <PointPotential W>
class ChainPotential final : public PointwisePotential {
 public:
  ChainPotential(W bond, W ground, Boundary boundary) : bonds_(bond, boundary), ground_(ground) {}

  double value(std::span<const double> u) const override {
    return bonds_.value(u) + sum_points(u.size(), [&](std::size_t j) { return ground_.value(u[j]); });
  }

  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override {
    ValueAndMagnitude sum = bonds_.value_and_magnitude(u);
    for (const double x : u) sum += ground_.value(x);
    return sum;
  }

  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override {
    double sum = bonds_.value_and_gradient(u, gradient);
    for (std::size_t j = 0; j < u.size(); ++j) {
      sum += ground_.value(u[j]);
      gradient[j] += ground_.slope(u[j]);
    }
    return sum;
  }

  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override {
    bonds_.mean_gradient(a, b, mean);
    for (std::size_t j = 0; j < a.size(); ++j) mean[j] += ground_.mean_slope(a[j], b[j]);
  }

  int degree() const override { return bonds_.degree(); }

  void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const override {
    bonds_.along(p, q, coefficients);
    if constexpr (requires { W::degree; }) {
      for (std::size_t j = 0; j < p.size(); ++j) ground_.add_along(p[j], q[j], coefficients.data());
    }
  }

  int homogeneity() const override {
    const int of_ground = homogeneity_of(ground_);
    return of_ground == bonds_.homogeneity() ? of_ground : 0;
  }
  bool grows_outward() const override { return bonds_.grows_outward() && ground_.grows_outward(); }

 private:
  BondPotential<W> bonds_;
  W ground_;
};

}  // namespace seiche
