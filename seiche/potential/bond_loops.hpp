// Loops over the bonds of a chain: V = Σ_j W(u_{j+1} − u_j), between n points on a ring, with both ends at u = 0, or
// with free ends.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/potential/loops.hpp>

namespace seiche {

// Σ W over the bonds between the points, and the one or two that close the chain where its ends are not free.
template <class W>
double sum_bond_values(const W& w, const double* u, std::size_t n, Boundary boundary) {
  return with_lanes([&]<class V>() __attribute__((always_inline)) {
    if (n == 0) return 0.0;
    const W local = w;
    const double between = sum_lanes<W, V>(
        n - 1, [&]<class X>(std::size_t j, const X&)
                   __attribute__((always_inline)) { return local.value(X(load<X>(u + j + 1) - load<X>(u + j))); });
    if (boundary == Boundary::neumann) return between;
    if (boundary == Boundary::periodic) return between + local.value(u[0] - u[n - 1]);
    return between + local.value(u[0]) + local.value(-u[n - 1]);
  });
}

// With x = in · u: gradient ← out · ∇V(x), which may be u itself; returns V(x). Point j is pulled by the bond before it
// and by the one after it, W'_{j−1} − W'_j, so that one slope goes from each point to the next.
template <class W>
double bond_gradient(const W& w, double in, double out, const double* u, double* gradient, std::size_t n,
                     Boundary boundary) {
  return with_lanes([&]<class V>() __attribute__((always_inline)) {
    if (n == 0) return 0.0;
    const W local = w;
    const double last = in * u[n - 1];
    double value = 0, before = 0, after = 0;
    if (boundary != Boundary::neumann) {
      const bool is_ring = boundary == Boundary::periodic;
      const double closing = is_ring ? in * u[0] - last : in * u[0];  // the stretch of the bond before the first point
      value = local.value(closing);
      before = local.slope(closing);
      after = is_ring ? before : local.slope(-last);
      if (!is_ring) value += local.value(-last);
    }
    std::size_t j = 0;
    if constexpr (TakesLanes<W>) {
      V slopes_before = V{} + before, sums{};
      for (; j + lane_count < n; j += lane_count) {
        const V stretch = in * load<V>(u + j + 1) - in * load<V>(u + j);
        const V slope = local.slope(stretch);
        sums += local.value(stretch);
        store<V>(gradient + j, out * (shifted(slopes_before, slope) - slope));
        slopes_before = slope;
      }
      before = last_of(slopes_before);
      value += sum(sums);
    }
    for (; j + 1 < n; ++j) {
      const double stretch = in * u[j + 1] - in * u[j];
      const double slope = local.slope(stretch);
      value += local.value(stretch);
      gradient[j] = out * (before - slope);
      before = slope;
    }
    gradient[n - 1] = out * (before - after);
    return value;
  });
}

}  // namespace seiche
