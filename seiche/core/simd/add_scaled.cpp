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

}  // namespace seiche
