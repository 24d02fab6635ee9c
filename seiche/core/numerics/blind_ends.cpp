#include <seiche/core/numerics/blind_ends.hpp>

#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace seiche {
namespace {

BlindEnds make_blind_ends() {
  BlindEnds ends{};
  const auto& half =
      boost::math::quadrature::gauss_kronrod<double, BlindEnds::count>::abscissa();  // ≥ 0, rising from 0
  constexpr std::size_t middle = BlindEnds::count / 2;
  for (std::size_t i = 0; i <= middle; ++i) {
    ends.points[middle - i] = (1 - half[i]) / 2;
    ends.points[middle + i] = (1 + half[i]) / 2;
  }
  const auto lagrange = [&](std::size_t i, double x) {
    double value = 1;
    for (std::size_t j = 0; j < BlindEnds::count; ++j)
      if (j != i) value *= (x - ends.points[j]) / (ends.points[i] - ends.points[j]);
    return value;
  };
  for (std::size_t i = 0; i < BlindEnds::count; ++i) {
    ends.to_begin[i] = lagrange(i, 0);
    ends.to_end[i] = lagrange(i, 1);
  }
  return ends;
}

}  // namespace

const BlindEnds& blind_ends() {
  static const BlindEnds ends = make_blind_ends();
  return ends;
}

}  // namespace seiche
