// V(u) = Σ_j W(u_j) for many states at once, W a polynomial of its own for each.
#pragma once

#include <seiche/core/panel_potential.hpp>
#include <seiche/core/simd/with_lanes.hpp>
#include <seiche/potential/polynomial.hpp>

#include <algorithm>
#include <memory>
#include <vector>

namespace seiche {

template <int Most>
class NodalPanel final : public PanelPotential {
 public:
  NodalPanel(const std::vector<Polynomial<Most>>& w, Index rows) : rows_(rows), c_(Most + 1), a_(rows) {
    for (Index i = 0; i <= Most; ++i)
      for (Index l = 0; l < panel_members; ++l)
        c_(i, l) = w[static_cast<std::size_t>(l)].c[static_cast<std::size_t>(i)];
  }

  void value_and_gradient(const double* u, double* gradient, PanelValues& values) const override {
    over_members(
        u,
        values.data(), [=]<class V>(const Polynomial<Most, V>& w, const V& x, Index at) __attribute__((always_inline)) {
          store<V>(gradient + at, w.slope(x));
          return w.value(x);
        });
  }
  void value_and_magnitude(const double* u, PanelValues& values, PanelValues& magnitudes) const override {
    const auto value = []<class V>(const Polynomial<Most, V>& w, const V& x, Index) __attribute__((always_inline)) {
      return w.value(x);
    };
    const auto size = []<class V>(const Polynomial<Most, V>& w, const V& x, Index) __attribute__((always_inline)) {
      return w.size(x);
    };
    over_members(u, values.data(), value);
    over_members(u, magnitudes.data(), size);
  }
  void begin_means(const double* a) override { std::copy_n(a, rows_ * panel_members, a_.row(0)); }
  void mean_gradient(const double* b, double* mean) const override {
    PanelValues unused;
    const double* const a = a_.row(0);
    over_members(
        b,
        unused.data(), [=]<class V>(const Polynomial<Most, V>& w, const V& x, Index at) __attribute__((always_inline)) {
          const V slope = w.mean_slope(load<V>(a + at), x);
          store<V>(mean + at, slope);
          return slope;
        });
  }

 private:
  // The sums over rows of what visit(w, x, place of x) gives for eight members at a time.
  template <class Visit>
  void over_members(const double* u, double* sums, const Visit& visit) const {
    with_lanes([ =, rows = rows_, c = c_.row(0) ]<class V>() __attribute__((always_inline)) {
      for (Index l = 0; l < panel_members; l += lane_count) {
        Polynomial<Most, V> w;
        for (Index i = 0; i <= Most; ++i) w.c[static_cast<std::size_t>(i)] = load<V>(c + i * panel_members + l);
        V sum{};
        for (Index j = 0; j < rows; ++j) {
          const Index at = j * panel_members + l;
          sum += visit(w, load<V>(u + at), at);
        }
        store<V>(sums + l, sum);
      }
    });
  }

  Index rows_;
  Panel c_, a_;
};

template <int Most>
std::unique_ptr<PanelPotential> panel_of(const std::vector<Polynomial<Most>>& w, Index rows) {
  return std::make_unique<NodalPanel<Most>>(w, rows);
}

}  // namespace seiche
