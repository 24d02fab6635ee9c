// The times of a run with one step size.
#pragma once

#include <seiche/core/base/error.hpp>
#include <seiche/core/base/vector.hpp>

#include <cmath>
#include <cstdint>

namespace seiche {

// t₀ + k h, k = 0 … steps; the last one is t_end, and its step is shortened where h does not divide the time. Throws
// Error for an h that is not finite and > 0, a t_end before the start, or more than 10¹⁵ steps.
struct TimeGrid {
  double start, h, end;
  std::int64_t steps = 0;
  double last_h = 0.0;

  TimeGrid(double t_start, double step_size, double t_end) : start(t_start), h(step_size), end(t_end) {
    if (!std::isfinite(h) || h <= 0) throw Error("the step size h must be finite and > 0, but it is {}", h);
    if (!std::isfinite(end) || !(end >= start))
      throw Error("t_end = {} must not lie before the start t = {}", end, start);
    const double quotient = (end - start) / h;
    if (quotient > 1e15) throw Error("h = {} would take {:.3g} steps to t = {}", h, quotient, end);
    const double nearest = std::round(quotient);
    const double round_off = 16 * epsilon * (std::abs(start) + std::abs(end)) / h;
    const bool divides = std::abs(quotient - nearest) <= round_off;
    steps = static_cast<std::int64_t>(divides ? nearest : std::ceil(quotient));
    last_h = divides ? h : end - (start + static_cast<double>(steps - 1) * h);
  }

  double time(std::int64_t k) const { return k == steps ? end : start + static_cast<double>(k) * h; }
  double step_size(std::int64_t k) const { return k == steps ? last_h : h; }  // of the step that ends at time(k)
  bool last_is_shortened() const { return last_h != h; }
};

}  // namespace seiche
