#include <seiche/core/simd/lanes.hpp>
#include <seiche/core/simd/multiversion.hpp>
#include <seiche/core/simd/squared_norm.hpp>

namespace seiche {
namespace {

SEICHE_MULTIVERSION double sum_of_squares(const double* x, Index n) {
  Lanes first{}, second{};
  Index j = 0;
  for (; j + 2 * lane_count <= n; j += 2 * lane_count) {
    const auto a = load<Lanes>(x + j);
    const auto b = load<Lanes>(x + j + lane_count);
    first += a * a;
    second += b * b;
  }
  double rest = 0;
  for (; j < n; ++j) rest += x[j] * x[j];
  return sum(Lanes(first + second)) + rest;
}

}  // namespace

double squared_norm(const double* x, Index n) { return sum_of_squares(x, n); }

}  // namespace seiche
