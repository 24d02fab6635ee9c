// V(u) = Σ_j W(u_{j+1} − u_j) over the bonds of a chain.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/potential/bond_loops.hpp>
#include <seiche/potential/bond_terms.hpp>
#include <seiche/potential/polynomial.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {

// Between N unknowns: N bonds of a ring (periodic), N + 1 with the first and last to an end where u = 0 (Dirichlet), or
// N − 1 with free ends (Neumann).
template <PointPotential W>
class BondPotential final : public PointwisePotential {
 public:
  BondPotential(W w, Boundary boundary) : w_(w), boundary_(boundary) {}

  double value(std::span<const double> u) const override { return sum_bond_values(w_, u.data(), u.size(), boundary_); }

  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override {
    if (u.empty()) return {};
    const auto stretch = [&](std::size_t j) { return u[j + 1] - u[j]; };
    ValueAndMagnitude sum = sum_points_and_sizes(
        u.size() - 1, [&](std::size_t j) { return w_.value(stretch(j)); },
        [&](std::size_t j, double value) { return size_of(w_, stretch(j), value); });
    for_ends(u, [&](std::size_t, std::size_t, double d) {
      const double value = w_.value(d);
      sum.value += value;
      sum.magnitude += size_of(w_, d, value);
    });
    return sum;
  }

  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override {
    return bond_gradient(w_, 1, 1, u.data(), gradient.data(), u.size(), boundary_);
  }

  double value_and_gradient_in_place(double in, double out, std::span<double> values) const override {
    return bond_gradient(w_, in, out, values.data(), values.data(), values.size(), boundary_);
  }

  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override {
    bond_mean_gradient(w_, a.data(), b.data(), mean.data(), std::ssize(a), boundary_);
  }

  int degree() const override {
    if constexpr (IsPolynomial<W>) return w_.degree();
    return 0;
  }

  void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const override {
    if constexpr (IsPolynomial<W>) {
      sum_coefficients(p.empty() ? 0 : p.size() - 1, coefficients,
                       [&](std::size_t j, double* into) { w_.add_along(p[j + 1] - p[j], q[j + 1] - q[j], into); });
      for_ends(p, [&](std::size_t left, std::size_t right, double d) {
        w_.add_along(d, at(q, right) - at(q, left), coefficients.data());
      });
    } else {
      std::fill(coefficients.begin(), coefficients.end(), 0.0);
    }
  }

  int homogeneity() const override { return homogeneity_of(w_); }
  bool grows_outward() const override { return w_.grows_outward(); }

  std::optional<std::vector<TermsOfPotential>> terms_at(Index first, Index count, Index of) const override {
    return bond_terms(std::make_shared<const BondPotential>(w_, Boundary::neumann), boundary_, first, count, of);
  }

 private:
  static constexpr std::size_t wall = static_cast<std::size_t>(-1);

  static double at(std::span<const double> u, std::size_t j) { return j == wall ? 0.0 : u[j]; }

  // The one or two bonds that close the chain, or none.
  template <class Visit>
  void for_ends(std::span<const double> u, const Visit& visit) const {
    const std::size_t n = u.size();
    if (n == 0) return;
    if (boundary_ == Boundary::periodic) {
      visit(n - 1, 0, u[0] - u[n - 1]);
    } else if (boundary_ == Boundary::dirichlet) {
      visit(wall, 0, u[0]);
      visit(n - 1, wall, -u[n - 1]);
    }
  }

  W w_;
  Boundary boundary_;
};

}  // namespace seiche
