#include <seiche/core/simd/products.hpp>
#include <seiche/core/simd/with_lanes.hpp>

namespace seiche {
namespace {

// Σⱼ xⱼyⱼ in two sums that do not wait for each other.
template <class V>
[[gnu::always_inline]] inline double product(const double* x, const double* y, Index n) {
  V first{}, second{};
  Index j = 0;
  for (; j + 2 * lane_count <= n; j += 2 * lane_count) {
    first += load<V>(x + j) * load<V>(y + j);
    second += load<V>(x + j + lane_count) * load<V>(y + j + lane_count);
  }
  for (; j + lane_count <= n; j += lane_count) first += load<V>(x + j) * load<V>(y + j);
  double rest = 0;
  for (; j < n; ++j) rest += x[j] * y[j];
  return sum(V(first + second)) + rest;
}

}  // namespace

double squared_norm(const double* x, Index n) {
  return with_lanes([=]<class V>() __attribute__((always_inline)) { return product<V>(x, x, n); });
}

double dot(const double* x, const double* y, Index n) {
  return with_lanes([=]<class V>() __attribute__((always_inline)) { return product<V>(x, y, n); });
}

ValueAndMagnitude dot_and_magnitude(const double* x, const double* y, Index n) {
  return with_lanes([=]<class V>() __attribute__((always_inline)) {
    V values{}, magnitudes{};
    ValueAndMagnitude rest;
    Index j = 0;
    for (; j + lane_count <= n; j += lane_count) {
      const V term = load<V>(x + j) * load<V>(y + j);
      values += term;
      magnitudes += absolute(term);
    }
    for (; j < n; ++j) rest += x[j] * y[j];
    return ValueAndMagnitude{sum(values) + rest.value, sum(magnitudes) + rest.magnitude};
  });
}

}  // namespace seiche
