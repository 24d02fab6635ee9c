#include <seiche/core/numerics/end_extrapolation.hpp>

#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace seiche {
namespace {

EndExtrapolation make_end_extrapolation() {
  EndExtrapolation ends{};
  const auto& half =
      boost::math::quadrature::gauss_kronrod<double, EndExtrapolation::count>::abscissa();  // ≥ 0, rising from 0
  constexpr std::size_t middle = EndExtrapolation::count / 2;
  for (std::size_t i = 0; i <= middle; ++i) {
    ends.points[middle - i] = (1 - half[i]) / 2;
    ends.points[middle + i] = (1 + half[i]) / 2;
  }
  const auto lagrange = [&](std::size_t i, double x) {
    double value = 1;
    for (std::size_t j = 0; j < EndExtrapolation::count; ++j)
      if (j != i) value *= (x - ends.points[j]) / (ends.points[i] - ends.points[j]);
    return value;
  };
  for (std::size_t i = 0; i < EndExtrapolation::count; ++i) {
    ends.to_begin[i] = lagrange(i, 0);
    ends.to_end[i] = lagrange(i, 1);
  }
  return ends;
}

}  // namespace

const EndExtrapolation& end_extrapolation() {
  static const EndExtrapolation ends = make_end_extrapolation();
  return ends;
}

}  // namespace seiche
