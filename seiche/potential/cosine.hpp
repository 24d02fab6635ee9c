// W(u) = α(1 − cos u): pendulums and sine-Gordon.
#pragma once

#include <seiche/core/simd/vector_functions.hpp>
#include <seiche/potential/panel_loops.hpp>

#include <cmath>
#include <cstddef>

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

// In cosine_panel.hpp, which whoever makes a NodalPotential<Cosine> includes.
template <>
class PanelW<Cosine>;

}  // namespace seiche
