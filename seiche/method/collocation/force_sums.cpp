#include <seiche/core/simd/lanes.hpp>
#include <seiche/core/simd/multiversion.hpp>
#include <seiche/method/collocation/force_sums.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace seiche {
namespace {

// `count` outputs at a time, whose sums the registers hold; squares[i] ← ‖out[i]‖².
template <int count>
SEICHE_MULTIVERSION void combine_some(const double* weights, Index weight_stride, const double* const* in, Index inputs,
                                      Index size, double* const* out, double* squares) {
  std::array<Lanes, count> lanes{};
  std::array<double, count> rest{};
  Index k = 0;
  for (; k + lane_count <= size; k += lane_count) {
    std::array<Lanes, count> sums{};
    for (Index j = 0; j < inputs; ++j) {
      const Lanes x = load<Lanes>(in[j] + k);
      for (int i = 0; i < count; ++i) sums[i] += weights[i + j * weight_stride] * x;
    }
    for (int i = 0; i < count; ++i) {
      store<Lanes>(out[i] + k, sums[i]);
      lanes[i] += sums[i] * sums[i];
    }
  }
  for (; k < size; ++k) {
    for (int i = 0; i < count; ++i) {
      double value = 0;
      for (Index j = 0; j < inputs; ++j) value += weights[i + j * weight_stride] * in[j][k];
      out[i][k] = value;
      rest[i] += value * value;
    }
  }
  for (int i = 0; i < count; ++i) squares[i] = sum(lanes[i]) + rest[i];
}

SEICHE_MULTIVERSION double squared_distance(const double* a, const double* b, Index size) {
  Lanes lanes{};
  double rest = 0;
  Index k = 0;
  for (; k + lane_count <= size; k += lane_count) {
    const Lanes d = load<Lanes>(a + k) - load<Lanes>(b + k);
    lanes += d * d;
  }
  for (; k < size; ++k) rest += (a[k] - b[k]) * (a[k] - b[k]);
  return sum(lanes) + rest;
}

constexpr Index most = 4;      // outputs at a time
constexpr Index most_in = 16;  // inputs

}  // namespace

double combine(const Space& space, const Eigen::MatrixXd& weights, std::span<const Vector> in, Index begin, Index size,
               std::span<Vector> out) {
  std::array<const double*, most_in> from{};
  std::array<double*, most> to{};
  std::array<double, most> squares{};
  for (std::size_t j = 0; j < in.size(); ++j) from[j] = in[j].data() + begin;
  double largest = 0;
  for (Index first = 0; first < weights.rows(); first += most) {
    const Index count = std::min(most, weights.rows() - first);
    for (Index i = 0; i < count; ++i)
      to[static_cast<std::size_t>(i)] = out[static_cast<std::size_t>(first + i)].data() + begin;
    const auto some = [&]<int known>() {
      combine_some<known>(weights.data() + first, weights.rows(), from.data(), weights.cols(), size, to.data(),
                          squares.data());
    };
    switch (count) {
      case 1: some.operator()<1>(); break;
      case 2: some.operator()<2>(); break;
      case 3: some.operator()<3>(); break;
      default: some.operator()<4>(); break;
    }
    space.sum({squares.data(), static_cast<std::size_t>(count)});
    for (Index i = 0; i < count; ++i) {
      const double square = squares[static_cast<std::size_t>(i)];
      largest = square <= largest ? largest : square;  // NaN counts as the largest
    }
  }
  return std::sqrt(largest);
}

double distance(const Space& space, const Vector& whole, Index begin, const Vector& b) {
  return std::sqrt(space.sum(squared_distance(whole.data() + begin, b.data(), b.size())));
}

}  // namespace seiche
