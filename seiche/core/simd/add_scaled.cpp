#include <seiche/core/simd/add_scaled.hpp>
#include <seiche/core/simd/with_lanes.hpp>

namespace seiche {

void add_scaled(const double* x, double a, const double* y, Index n, double* out) {
  with_lanes([=]<class V>() __attribute__((always_inline)) {
    for_lanes<V>(
        0, n, [=]<class X>(Index j, const X&) __attribute__((always_inline)) {
          store<X>(out + j, load<X>(x + j) + a * load<X>(y + j));
        });
  });
}

void scale(const double* y, double a, Index n, double* out) {
  with_lanes([=]<class V>() __attribute__((always_inline)) {
    for_lanes<V>(
        0, n, [=]<class X>(Index j, const X&) __attribute__((always_inline)) {
          store<X>(out + j, X(a * load<X>(y + j)));
        });
  });
}

double add_scaled_and_weigh(double* x, double a, const double* y, Index n) {
  return with_lanes([=]<class V>() __attribute__((always_inline)) {
    return sum_lanes<V>(
        0, n, [=]<class X>(Index j, const X&) __attribute__((always_inline)) {
          const X before = load<X>(x + j), other = load<X>(y + j), after = before + a * other;
          store<X>(x + j, after);
          return X(other * (before + after));
        });
  });
}

}  // namespace seiche
