#include <bench/peers/energy_line.hpp>
#include <bench/peers/right_hand_side.hpp>

#include <algorithm>
#include <numeric>

namespace seiche::bench {
namespace {

using Kind = Equation::Kind;

double dot(const double* a, const double* b, std::size_t n) { return std::transform_reduce(a, a + n, b, 0.0); }

// u_{j+1} − u_j over all bonds, the ends at rest
template <class Use>
void for_bonds(const double* u, const double* d, std::size_t n, const Use& use) {
  use(u[0], d[0]);
  for (std::size_t j = 1; j < n; ++j) use(u[j] - u[j - 1], d[j] - d[j - 1]);
  use(-u[n - 1], -d[n - 1]);
}

}  // namespace

EnergyLine::EnergyLine(const Equation& equation) : equation_(equation), laplacian_(equation.unknowns()) {}

EnergyLine::Coefficients EnergyLine::along(const double* z, const double* d) {
  const Equation& e = equation_;
  const std::size_t n = e.unknowns();
  std::fill(laplacian_.begin(), laplacian_.end(), 0.0);
  add_laplacian(e, -e.stiffness, d, laplacian_.data());
  Coefficients c{dot(z, laplacian_.data(), n), dot(d, laplacian_.data(), n) / 2, 0, 0};
  const double s = e.strength;
  if (e.is_second_order()) {
    c[0] += e.mass_squared * dot(z, d, n) + dot(z + n, d + n, n);
    c[1] += (e.mass_squared * dot(d, d, n) + dot(d + n, d + n, n)) / 2;
  }
  switch (e.kind) {
    case Kind::klein_gordon:
      for (std::size_t j = 0; j < n; ++j) {
        const double u2 = z[j] * z[j], d2 = d[j] * d[j];
        c[0] += s * u2 * z[j] * d[j];
        c[1] += 1.5 * s * u2 * d2;
        c[2] += s * z[j] * d[j] * d2;
        c[3] += s / 4 * d2 * d2;
      }
      break;
    case Kind::alpha_fpu: {
      const double w = s / (6 * e.dx * e.dx * e.dx);
      for_bonds(z, d, n, [&](double u, double of_d) {
        c[0] += 3 * w * u * u * of_d;
        c[1] += 3 * w * u * of_d * of_d;
        c[2] += w * of_d * of_d * of_d;
      });
      break;
    }
    case Kind::gkdv:
      for (std::size_t j = 0; j < n; ++j) {
        c[0] -= s * z[j] * z[j] * d[j];
        c[1] -= s * z[j] * d[j] * d[j];
        c[2] -= s / 3 * d[j] * d[j] * d[j];
      }
      break;
    case Kind::allen_cahn:
    case Kind::cahn_hilliard: break;
  }
  return c;
}

double EnergyLine::rate(const double* z) {
  const Equation& e = equation_;
  const std::size_t n = e.unknowns();
  const double* moved = e.is_second_order() ? z + n : z;
  std::fill(laplacian_.begin(), laplacian_.end(), 0.0);
  if (e.kind == Kind::gkdv) {  // −μuᵀ∇H
    add_laplacian(e, -e.stiffness, z, laplacian_.data());
    double rate = dot(z, laplacian_.data(), n);
    for (std::size_t j = 0; j < n; ++j) rate -= e.strength * z[j] * z[j] * z[j];
    return -e.gamma * rate;
  }
  double rate = -e.gamma * dot(moved, moved, n);
  if (e.beta != 0) {
    add_laplacian(e, e.beta, moved, laplacian_.data());
    rate += dot(moved, laplacian_.data(), n);
  }
  return rate;
}

}  // namespace seiche::bench
