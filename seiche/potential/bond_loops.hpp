// Loops over the bonds of a chain: V = Σ_j W(u_{j+1} − u_j), between n points on a ring, with both ends at u = 0, or
// with free ends.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/potential/loops.hpp>

#include <utility>

namespace seiche {

// Σ W over the bonds between the points, and the one or two that close the chain where its ends are not free.
template <class W>
double sum_bond_values(const W& w, const double* u, std::size_t n, Boundary boundary) {
  return with_lanes([=]<class V>() __attribute__((always_inline)) {
    if (n == 0) return 0.0;
    const double between = sum_points_in_lanes<W, V>(
        n - 1, [=]<class X>(Index j, const X&)
                   __attribute__((always_inline)) { return w.value(X(load<X>(u + j + 1) - load<X>(u + j))); });
    if (boundary == Boundary::neumann) return between;
    if (boundary == Boundary::periodic) return between + w.value(u[0] - u[n - 1]);
    return between + w.value(u[0]) + w.value(-u[n - 1]);
  });
}

// The two slopes that close a chain: of the bond before the first point and of the one after the last, from what the
// slope of a bond is between two points, of which −1 is held at u = 0.
template <class Slope>
[[gnu::always_inline]] inline std::pair<double, double> slopes_of_ends(std::ptrdiff_t n, Boundary boundary,
                                                                       const Slope& slope) {
  if (boundary == Boundary::neumann) return {0, 0};
  if (boundary == Boundary::dirichlet) return {slope(-1, 0), slope(n - 1, -1)};
  const double closing = slope(n - 1, 0);
  return {closing, closing};
}

// The mean of gradients along the line from a to b.
template <class W>
void bond_mean_gradient(const W& w, const double* a, const double* b, double* mean, Index n, Boundary boundary) {
  with_lanes([=]<class V>() __attribute__((always_inline)) {
    if (n == 0) return;
    const auto stretch = [](const double* u, Index left, Index right) __attribute__((always_inline)) {
      return (right < 0 ? 0.0 : u[right]) - (left < 0 ? 0.0 : u[left]);
    };
    auto [before, after] = slopes_of_ends(
        n, boundary, [=](Index left, Index right) __attribute__((always_inline)) {
          return w.mean_slope(stretch(a, left, right), stretch(b, left, right));
        });
    Index j = 0;
    if constexpr (HasMeansOfLanes<W>) {
      V slopes_before = V{} + before;
      for (; j + lane_count < n; j += lane_count) {
        const V slope = w.mean_slope(V(load<V>(a + j + 1) - load<V>(a + j)), V(load<V>(b + j + 1) - load<V>(b + j)));
        store<V>(mean + j, shifted(slopes_before, slope) - slope);
        slopes_before = slope;
      }
      before = last_of(slopes_before);
    }
    for (; j + 1 < n; ++j) {
      const double slope = w.mean_slope(a[j + 1] - a[j], b[j + 1] - b[j]);
      mean[j] = before - slope;
      before = slope;
    }
    mean[n - 1] = before - after;
  });
}

// With x = in · u: gradient ← out · ∇V(x), which may be u itself; returns V(x). Point j is pulled by the bond before it
// and by the one after it, W'_{j−1} − W'_j, so that one slope goes from each point to the next.
template <class W>
double bond_gradient(const W& w, double in, double out, const double* u, double* gradient, std::size_t n,
                     Boundary boundary) {
  return with_lanes([=]<class V>() __attribute__((always_inline)) {
    if (n == 0) return 0.0;
    const double last = in * u[n - 1];
    double value = 0, before = 0, after = 0;
    if (boundary != Boundary::neumann) {
      const bool is_ring = boundary == Boundary::periodic;
      const double closing = is_ring ? in * u[0] - last : in * u[0];  // the stretch of the bond before the first point
      value = w.value(closing);
      before = w.slope(closing);
      after = is_ring ? before : w.slope(-last);
      if (!is_ring) value += w.value(-last);
    }
    std::size_t j = 0;
    if constexpr (TakesLanes<W>) {
      V slopes_before = V{} + before, sums{};
      for (; j + lane_count < n; j += lane_count) {
        const V stretch = in * load<V>(u + j + 1) - in * load<V>(u + j);
        const V slope = w.slope(stretch);
        sums += w.value(stretch);
        store<V>(gradient + j, out * (shifted(slopes_before, slope) - slope));
        slopes_before = slope;
      }
      before = last_of(slopes_before);
      value += sum(sums);
    }
    for (; j + 1 < n; ++j) {
      const double stretch = in * u[j + 1] - in * u[j];
      const double slope = w.slope(stretch);
      value += w.value(stretch);
      gradient[j] = out * (before - slope);
      before = slope;
    }
    gradient[n - 1] = out * (before - after);
    return value;
  });
}

}  // namespace seiche
