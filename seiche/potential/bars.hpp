// V(u) = Σ_bars W(n·(u_b − u_a)): bars between the nodes of a truss in the plane, by the part of the displacement along
// them.
#pragma once

#include <seiche/core/potential.hpp>
#include <seiche/potential/loops.hpp>
#include <seiche/potential/polynomial.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace seiche {

// From node a to node b along the unit vector n; a negative node is a support, which does not move.
struct Bar {
  Index a, b;
  double nx, ny;
};

// Reads two fields, the displacements (x of all nodes, then y).
template <PointPotential W>
class BarPotential final : public PointwisePotential {
 public:
  BarPotential(W w, std::vector<Bar> bars) : w_(w), bars_(std::move(bars)) {}

  Index fields() const override { return 2; }

  double value(std::span<const double> u) const override {
    double sum = 0;
    for (const Bar& bar : bars_) sum += w_.value(elongation(bar, u));
    return sum;
  }

  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override {
    ValueAndMagnitude sum;
    for (const Bar& bar : bars_) {
      const double e = elongation(bar, u);
      const double value = w_.value(e);
      sum.value += value;
      sum.magnitude += size_of(w_, e, value);
    }
    return sum;
  }

  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override {
    std::fill(gradient.begin(), gradient.end(), 0.0);
    double sum = 0;
    for (const Bar& bar : bars_) {
      const double e = elongation(bar, u);
      sum += w_.value(e);
      pull(bar, gradient, w_.slope(e));
    }
    return sum;
  }

  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override {
    std::fill(mean.begin(), mean.end(), 0.0);
    for (const Bar& bar : bars_) pull(bar, mean, w_.mean_slope(elongation(bar, a), elongation(bar, b)));
  }

  int degree() const override {
    if constexpr (IsPolynomial<W>) return w_.degree();
    return 0;
  }

  void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const override {
    std::fill(coefficients.begin(), coefficients.end(), 0.0);
    if constexpr (IsPolynomial<W>) {
      for (const Bar& bar : bars_) w_.add_along(elongation(bar, p), elongation(bar, q), coefficients.data());
    }
  }

  int homogeneity() const override { return homogeneity_of(w_); }
  bool grows_outward() const override { return w_.grows_outward(); }  // u·∇V = Σ e W'(e)

  // A bar belongs to the first of its nodes that moves.
  std::optional<std::vector<TermsOfPotential>> terms_at(Index first, Index count, Index /*of*/) const override {
    const auto is_here = [=](Index node) { return node >= first && node < first + count; };
    std::array<std::vector<Bar>, 2> bars;  // of other nodes, of these
    for (const Bar& bar : bars_)
      if (is_here(bar.a) || is_here(bar.b)) bars[is_here(bar.a >= 0 ? bar.a : bar.b) ? 1 : 0].push_back(bar);
    std::vector<TermsOfPotential> terms;
    for (const bool own : {false, true}) terms.push_back(terms_of(std::move(bars[own ? 1 : 0]), own));
    return terms;
  }

 private:
  TermsOfPotential terms_of(std::vector<Bar> bars, bool is_counted) const {
    std::vector<Index> nodes;
    for (const Bar& bar : bars)
      for (const Index node : {bar.a, bar.b})
        if (node >= 0) nodes.push_back(node);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (Bar& bar : bars)
      for (Index* node : {&bar.a, &bar.b})
        if (*node >= 0) *node = std::lower_bound(nodes.begin(), nodes.end(), *node) - nodes.begin();
    return {.points = std::move(nodes),
            .potential = std::make_shared<const BarPotential>(w_, std::move(bars)),
            .is_counted = is_counted};
  }

  static double elongation(const Bar& bar, std::span<const double> u) {
    const std::size_t n = u.size() / 2;
    double e = 0;
    if (bar.b >= 0) e += bar.nx * u[static_cast<std::size_t>(bar.b)] + bar.ny * u[n + static_cast<std::size_t>(bar.b)];
    if (bar.a >= 0) e -= bar.nx * u[static_cast<std::size_t>(bar.a)] + bar.ny * u[n + static_cast<std::size_t>(bar.a)];
    return e;
  }

  static void pull(const Bar& bar, std::span<double> gradient, double slope) {
    const std::size_t n = gradient.size() / 2;
    for (const auto& [node, sign] : {std::pair{bar.a, -slope}, std::pair{bar.b, slope}}) {
      if (node < 0) continue;
      gradient[static_cast<std::size_t>(node)] += sign * bar.nx;
      gradient[n + static_cast<std::size_t>(node)] += sign * bar.ny;
    }
  }

  W w_;
  std::vector<Bar> bars_;
};

}  // namespace seiche
