#include <seiche/backend/fft/line_kinds.hpp>

#include <fftw3.h>

#include <cmath>

namespace seiche {

LineKinds kinds_of(Boundary boundary) {
  switch (boundary) {
    case Boundary::dirichlet: return {FFTW_RODFT00, FFTW_RODFT00};
    case Boundary::neumann: return {FFTW_REDFT10, FFTW_REDFT01};
    case Boundary::periodic: break;
  }
  return {FFTW_R2HC, FFTW_HC2R};
}

std::vector<Index> modes_alone(const GridAxis& axis) {
  if (axis.boundary == Boundary::dirichlet) return {};
  if (axis.boundary == Boundary::periodic && axis.intervals % 2 == 0) return {0, axis.intervals / 2};
  return {0};
}

double slot_scale(const GridAxis& axis) {
  const auto n = static_cast<double>(axis.intervals);
  return axis.boundary == Boundary::periodic ? std::sqrt(2 / n) : 1 / std::sqrt(2 * n);
}

double value_scale(const GridAxis& axis) { return 1 / std::sqrt(2 * static_cast<double>(axis.intervals)); }

}  // namespace seiche
