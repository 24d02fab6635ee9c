#include <seiche/core/simd/squared_norm.hpp>
#include <seiche/core/simd/with_lanes.hpp>

namespace seiche {
namespace {

template <class V>
[[gnu::always_inline]] inline double sum_of_squares(const double* x, Index n) {
  V first{}, second{};
  Index j = 0;
  for (; j + 2 * lane_count <= n; j += 2 * lane_count) {
    const auto a = load<V>(x + j);
    const auto b = load<V>(x + j + lane_count);
    first += a * a;
    second += b * b;
  }
  double rest = 0;
  for (; j < n; ++j) rest += x[j] * x[j];
  return sum(V(first + second)) + rest;
}

}  // namespace

double squared_norm(const double* x, Index n) {
  return with_lanes([=]<class V>() __attribute__((always_inline)) { return sum_of_squares<V>(x, n); });
}

}  // namespace seiche
