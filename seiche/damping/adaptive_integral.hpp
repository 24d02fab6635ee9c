// ∫₀¹ f(s) ds for rates.
#pragma once

namespace seiche {

// Adaptive, with positive weights, so that f ≥ 0 gives ∫f ≥ 0. NaN where it does not converge, as at a pole. Allocates
// nothing.
double adaptive_integral(double (*f)(const void* data, double s), const void* data);

template <class F>
double adaptive_integral(const F& f) {
  return adaptive_integral([](const void* data, double s) { return (*static_cast<const F*>(data))(s); }, &f);
}

}  // namespace seiche
