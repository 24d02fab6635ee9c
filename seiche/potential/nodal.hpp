// V(u) = Σ_j W(u_j).
#pragma once

#include <seiche/core/potential.hpp>
#include <seiche/potential/loops.hpp>
#include <seiche/potential/nodal_panel.hpp>
#include <seiche/potential/polynomial.hpp>

#include <algorithm>

namespace seiche {

template <PointPotential W>
class NodalPotential final : public PointwisePotential {
 public:
  explicit NodalPotential(W w) : w_(w), homogeneity_(homogeneity_of(w)) {}

  bool is_local() const override { return true; }

  double value(std::span<const double> u) const override { return sum_values(w_, u.data(), u.size()); }

  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override {
    return sum_values_and_magnitudes(w_, u.data(), u.size());
  }

  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override {
    return sum_values_and_slopes(w_, u.data(), gradient.data(), u.size());
  }

  void gradient(std::span<const double> u, std::span<double> out) const override {
    slopes(w_, u.data(), out.data(), u.size());
  }

  double value_and_gradient_in_place(double in, double out, std::span<double> values) const override {
    return slopes_in_place(w_, in, out, values.data(), values.size());
  }

  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override {
    mean_slopes(w_, a.data(), b.data(), mean.data(), a.size());
  }

  int degree() const override {
    if constexpr (IsPolynomial<W>) return w_.degree();
    return 0;
  }

  void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const override {
    if constexpr (IsPolynomial<W>) {
      sum_coefficients(p.size(), coefficients, [&](std::size_t j, double* into) { w_.add_along(p[j], q[j], into); });
    } else {
      std::fill(coefficients.begin(), coefficients.end(), 0.0);
    }
  }

  int homogeneity() const override { return homogeneity_; }
  bool grows_outward() const override { return w_.grows_outward(); }

  std::unique_ptr<PanelPotential> for_members(PanelMembers members, Index rows) const override {
    if constexpr (requires(std::vector<W> w) { panel_of(w, rows); }) {
      std::vector<W> w;
      for (const auto& member : members)
        if (const auto* same = dynamic_cast<const NodalPotential*>(member.get())) w.push_back(same->w_);
      if (w.size() == members.size()) return panel_of(w, rows);
    }
    return member_by_member(members, rows);
  }

 private:
  W w_;
  int homogeneity_;
};

}  // namespace seiche
