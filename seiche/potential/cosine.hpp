// W(u) = α(1 − cos u): pendulums and sine-Gordon.
#pragma once

#include <seiche/core/panel_potential.hpp>
#include <seiche/core/simd/vector_functions.hpp>
#include <seiche/core/simd/with_lanes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace seiche {

struct Cosine {
  double alpha = 1.0;

  double value(double u) const {
    const double s = std::sin(u / 2);
    return 2 * alpha * s * s;
  }
  double slope(double u) const { return alpha * std::sin(u); }
  // (cos a − cos b) / (b − a) = sin((a + b)/2) · sin(d)/d with d = (b − a)/2
  double mean_slope(double a, double b) const {
    const double d = (b - a) / 2;
    return alpha * std::sin((a + b) / 2) * sinc(d, std::sin(d));
  }
  bool grows_outward() const { return alpha == 0; }

  // The same of a block of points. With s = sin(u/2) and c = cos(u/2), W = 2αs² and W' = 2αsc: one reduction of the
  // argument gives both.
  [[gnu::always_inline]] void values(const double* u, double* w, std::size_t n) const {
    for (std::size_t j = 0; j < n; ++j) w[j] = u[j] / 2;
    vector_functions().sin(w, w, n);
    for (std::size_t j = 0; j < n; ++j) w[j] = 2 * alpha * w[j] * w[j];
  }
  [[gnu::always_inline]] void values_and_slopes(const double* u, double* w, double* slopes, std::size_t n) const {
    for (std::size_t j = 0; j < n; ++j) w[j] = u[j] / 2;
    vector_functions().sincos(w, w, slopes, n);
    for (std::size_t j = 0; j < n; ++j) {
      const double twice = 2 * alpha * w[j];
      slopes[j] *= twice;
      w[j] *= twice;
    }
  }
  // |W| + |u W'|: what round-off in u makes of it counts too, far from 0 that is more than W.
  [[gnu::always_inline]] void values_and_sizes(const double* u, double* w, double* sizes, std::size_t n) const {
    values_and_slopes(u, w, sizes, n);
    for (std::size_t j = 0; j < n; ++j) sizes[j] = std::abs(w[j]) + std::abs(u[j] * sizes[j]);
  }
  // `scratch` takes 2n numbers.
  [[gnu::always_inline]] void mean_slopes(const double* a, const double* b, double* mean, double* scratch,
                                          std::size_t n) const {
    double* const d = scratch;
    double* const sines = scratch + n;
    for (std::size_t j = 0; j < n; ++j) {
      d[j] = (b[j] - a[j]) / 2;
      mean[j] = (a[j] + b[j]) / 2;
    }
    vector_functions().sin(d, sines, n);
    vector_functions().sin(mean, mean, n);
    for (std::size_t j = 0; j < n; ++j) mean[j] = alpha * mean[j] * sinc(d[j], sines[j]);
  }

 private:
  // sin(d)/d
  static double sinc(double d, double sine) { return std::abs(d) < 1e-4 ? 1 - d * d / 6 : sine / d; }
};

// Σ_j of it for many states at once: with α = 1 in one pass over all of them, and then the α of each.
class CosinePanel final : public PanelPotential {
 public:
  CosinePanel(const std::vector<Cosine>& w, Index rows) : rows_(rows), a_(rows), of_points_(rows), scratch_(2 * rows) {
    for (std::size_t l = 0; l < alpha_.size(); ++l) alpha_[l] = w[l].alpha;
  }

  void value_and_gradient(const double* u, double* gradient, PanelValues& values) const override {
    double* const w = of_points_.row(0);
    with_lanes([ =, n = size() ]<class V>()
                   __attribute__((always_inline)) { Cosine{}.values_and_slopes(u, w, gradient, n); });
    add_and_scale(w, gradient, values);
  }
  void value_and_magnitude(const double* u, PanelValues& values, PanelValues& magnitudes) const override {
    double *const w = of_points_.row(0), *const sizes = scratch_.row(0);
    Cosine{}.values_and_sizes(u, w, sizes, size());
    add_and_scale(w, w, values);
    add_and_scale(sizes, sizes, magnitudes);
    for (double& magnitude : magnitudes) magnitude = std::abs(magnitude);
  }
  void begin_means(const double* a) override { std::copy_n(a, size(), a_.row(0)); }
  void mean_gradient(const double* b, double* mean) const override {
    const double* const a = a_.row(0);
    double* const scratch = scratch_.row(0);
    with_lanes([ =, n = size() ]<class V>()
                   __attribute__((always_inline)) { Cosine{}.mean_slopes(a, b, mean, scratch, n); });
    PanelValues unused;
    add_and_scale(mean, mean, unused);
  }

 private:
  std::size_t size() const { return static_cast<std::size_t>(rows_ * panel_members); }
  // α times the sums of numbers over rows, and other numbers times α.
  void add_and_scale(const double* numbers, double* others, PanelValues& sums) const {
    with_lanes([ =, rows = rows_, alpha = alpha_.data(), to = sums.data() ]<class V>() __attribute__((always_inline)) {
      for (Index l = 0; l < panel_members; l += lane_count) {
        const V factor = load<V>(alpha + l);
        V sum{};
        for (Index at = l; at < rows * panel_members; at += panel_members) {
          sum += load<V>(numbers + at);
          store<V>(others + at, factor * load<V>(others + at));
        }
        store<V>(to + l, factor * sum);
      }
    });
  }

  Index rows_;
  PanelValues alpha_{};
  Panel a_;
  mutable Panel of_points_, scratch_;
};

inline std::unique_ptr<PanelPotential> panel_of(const std::vector<Cosine>& w, Index rows) {
  return std::make_unique<CosinePanel>(w, rows);
}

}  // namespace seiche
