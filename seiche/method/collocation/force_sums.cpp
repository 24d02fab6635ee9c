#include <seiche/core/simd/with_lanes.hpp>
#include <seiche/method/collocation/force_sums.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace seiche {
namespace {

// `count` outputs at a time, whose sums the registers hold; squares[i] += ‖out[i]‖² of this part.
template <class V, int count>
[[gnu::always_inline]] inline void combine_some(const double* weights, Index weight_stride, const double* const* in,
                                                Index inputs, Index begin, Index end, double* const* out,
                                                double* squares) {
  std::array<V, count> lanes{};
  std::array<double, count> rest{};
  Index k = begin;
  for (; k + lane_count <= end; k += lane_count) {
    std::array<V, count> sums{};
    for (Index j = 0; j < inputs; ++j) {
      const V x = load<V>(in[j] + k);
      for (int i = 0; i < count; ++i) sums[i] += weights[i + j * weight_stride] * x;
    }
    for (int i = 0; i < count; ++i) {
      store<V>(out[i] + k, sums[i]);
      lanes[i] += sums[i] * sums[i];
    }
  }
  for (; k < end; ++k) {
    for (int i = 0; i < count; ++i) {
      double value = 0;
      for (Index j = 0; j < inputs; ++j) value += weights[i + j * weight_stride] * in[j][k];
      out[i][k] = value;
      rest[i] += value * value;
    }
  }
  for (int i = 0; i < count; ++i) squares[i] += sum(lanes[i]) + rest[i];
}

template <class V>
[[gnu::always_inline]] inline double squared_distance(const double* a, const double* b, Index size) {
  V lanes{};
  double rest = 0;
  Index k = 0;
  for (; k + lane_count <= size; k += lane_count) {
    const V d = load<V>(a + k) - load<V>(b + k);
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
  const Space::Field field = space.slots();
  for (std::size_t j = 0; j < in.size(); ++j) from[j] = in[j].data() + begin;
  double largest = 0;
  for (Index first = 0; first < weights.rows(); first += most) {
    const Index count = std::min(most, weights.rows() - first);
    for (Index i = 0; i < count; ++i)
      to[static_cast<std::size_t>(i)] = out[static_cast<std::size_t>(first + i)].data() + begin;
    const auto some = [&]<int known>() {
      const auto of_unit = [&](Index unit, std::span<double> sums) {
        std::fill(sums.begin(), sums.end(), 0.0);
        field.for_parts(size, unit, [&](Index at, Index length) {
          with_lanes([&]<class V>() __attribute__((always_inline)) {
            combine_some<V, known>(weights.data() + first, weights.rows(), from.data(), weights.cols(), at, at + length,
                                   to.data(), sums.data());
          });
        });
      };
      space.add(field.units, of_unit, std::span(squares).first(known));
    };
    switch (count) {
      case 1: some.operator()<1>(); break;
      case 2: some.operator()<2>(); break;
      case 3: some.operator()<3>(); break;
      default: some.operator()<4>(); break;
    }
    for (Index i = 0; i < count; ++i) {
      const double square = squares[static_cast<std::size_t>(i)];
      largest = square <= largest ? largest : square;  // NaN counts as the largest
    }
  }
  return std::sqrt(largest);
}

double distance(const Space& space, const Vector& whole, Index begin, const Vector& b) {
  const Space::Field field = space.slots();
  return std::sqrt(space.total(field.units, [&](Index unit) {
    double sum = 0;
    field.for_parts(b.size(), unit, [&](Index at, Index length) {
      sum += with_lanes([&]<class V>() __attribute__((always_inline)) {
        return squared_distance<V>(whole.data() + begin + at, b.data() + at, length);
      });
    });
    return sum;
  }));
}

}  // namespace seiche
