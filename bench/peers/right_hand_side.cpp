#include <bench/peers/right_hand_side.hpp>

#include <algorithm>

namespace seiche::bench {
namespace {

using Kind = Equation::Kind;

// One row of the five-point (or, with up and down null, three-point) Laplacian, periodic along the row.
struct RowLaplacian {
  std::size_t n;
  const double* u;
  const double* up;
  const double* down;

  template <class Use>
  void operator()(const Use& use) const {
    if (up) {
      use(std::size_t{0}, u[n - 1] + u[1] + up[0] + down[0] - 4 * u[0]);
      for (std::size_t j = 1; j + 1 < n; ++j) use(j, u[j - 1] + u[j + 1] + up[j] + down[j] - 4 * u[j]);
      use(n - 1, u[n - 2] + u[0] + up[n - 1] + down[n - 1] - 4 * u[n - 1]);
    } else {
      use(std::size_t{0}, u[n - 1] + u[1] - 2 * u[0]);
      for (std::size_t j = 1; j + 1 < n; ++j) use(j, u[j - 1] + u[j + 1] - 2 * u[j]);
      use(n - 1, u[n - 2] + u[0] - 2 * u[n - 1]);
    }
  }
};

RowLaplacian row_laplacian(const Equation& e, const double* u, std::size_t row) {
  const std::size_t n = e.columns;
  if (e.rows == 1) return {n, u, nullptr, nullptr};
  return {n, u + row * n, u + (row + 1) % e.rows * n, u + (row + e.rows - 1) % e.rows * n};
}

}  // namespace

void add_laplacian(const Equation& e, double factor, const double* u, double* out) {
  const double c = factor / (e.dx * e.dx);
  if (!e.is_periodic()) {
    const std::size_t n = e.columns;
    out[0] += c * (u[1] - 2 * u[0]);
    for (std::size_t j = 1; j + 1 < n; ++j) out[j] += c * (u[j - 1] + u[j + 1] - 2 * u[j]);
    out[n - 1] += c * (u[n - 2] - 2 * u[n - 1]);
    return;
  }
  for (std::size_t row = 0; row < e.rows; ++row) {
    double* o = out + row * e.columns;
    row_laplacian(e, u, row)([=](std::size_t j, double sum) { o[j] += c * sum; });
  }
}

RightHandSide::RightHandSide(const Equation& equation) : equation_(equation), flux_(equation.unknowns() + 2) {}

void RightHandSide::full(const double* z, double* dz) {
  ++evaluations;
  switch (equation_.kind) {
    case Kind::klein_gordon: return wave(z, dz);
    case Kind::alpha_fpu: return fpu(z, dz);
    case Kind::gkdv: return gkdv(z, dz);
    case Kind::allen_cahn: return allen_cahn(z, dz);
    case Kind::cahn_hilliard: return cahn_hilliard(z, dz);
  }
}

void RightHandSide::wave(const double* z, double* dz) const {
  const Equation& e = equation_;
  const std::size_t n = e.unknowns();
  const double c = e.stiffness / (e.dx * e.dx);
  const double m2 = e.mass_squared;
  const double alpha = e.strength;
  const double gamma = e.gamma;
  std::copy_n(z + n, n, dz);
  for (std::size_t row = 0; row < e.rows; ++row) {
    const double* u = z + row * e.columns;
    const double* v = u + n;
    double* dv = dz + n + row * e.columns;
    row_laplacian(e, z, row)(
        [=](std::size_t j, double sum) { dv[j] = c * sum - (m2 + alpha * u[j] * u[j]) * u[j] - gamma * v[j]; });
  }
}

void RightHandSide::fpu(const double* z, double* dz) const {
  const Equation& e = equation_;
  const std::size_t n = e.unknowns();
  const double* u = z;
  const double* v = z + n;
  double* s = flux_.data();  // stress in bond j, between unknowns j − 1 and j, without the factor 1/Δx²
  const double a = e.strength / (2 * e.dx);
  const double beta = e.beta;
  const auto stress = [=](double du, double dv) { return du * (1 + a * du) + beta * dv; };
  s[0] = stress(u[0], v[0]);
  for (std::size_t j = 1; j < n; ++j) s[j] = stress(u[j] - u[j - 1], v[j] - v[j - 1]);
  s[n] = stress(-u[n - 1], -v[n - 1]);
  const double c = 1 / (e.dx * e.dx);
  const double m2 = e.mass_squared;
  const double gamma = e.gamma;
  std::copy_n(v, n, dz);
  double* out = dz + n;
  for (std::size_t j = 0; j < n; ++j) out[j] = c * (s[j + 1] - s[j]) - m2 * u[j] - gamma * v[j];
}

void RightHandSide::gkdv(const double* z, double* dz) const {
  const Equation& e = equation_;
  const std::size_t n = e.unknowns();
  double* w = flux_.data() + 1;  // ∇H
  const double a = -e.stiffness / (e.dx * e.dx);
  const double sigma = e.strength;
  const RowLaplacian laplacian{n, z, nullptr, nullptr};
  laplacian([=](std::size_t j, double sum) { w[j] = a * sum - sigma * z[j] * z[j]; });
  flux_[0] = w[n - 1];
  flux_[n + 1] = w[0];
  const double c = 1 / (2 * e.dx);
  const double mu = e.gamma;
  const double* f = flux_.data();
  for (std::size_t j = 0; j < n; ++j) dz[j] = c * (f[j + 2] - f[j]) - mu * z[j];
}

void RightHandSide::allen_cahn(const double* u, double* du) const {
  const Equation& e = equation_;
  const double c = e.stiffness / (e.dx * e.dx);
  for (std::size_t row = 0; row < e.rows; ++row) {
    const double* v = u + row * e.columns;
    double* out = du + row * e.columns;
    row_laplacian(e, u, row)([=](std::size_t j, double sum) { out[j] = c * sum + v[j] - v[j] * v[j] * v[j]; });
  }
}

void RightHandSide::cahn_hilliard(const double* u, double* du) const {
  const Equation& e = equation_;
  const double c = -e.stiffness / (e.dx * e.dx);
  for (std::size_t row = 0; row < e.rows; ++row) {
    const double* v = u + row * e.columns;
    double* w = flux_.data() + row * e.columns;  // ∇H
    row_laplacian(e, u, row)([=](std::size_t j, double sum) { w[j] = c * sum + v[j] * v[j] * v[j] - v[j]; });
  }
  std::fill_n(du, e.unknowns(), 0.0);
  add_laplacian(e, 1, flux_.data(), du);
}

void RightHandSide::linear(const double* z, double* dz) const {
  const Equation& e = equation_;
  const std::size_t n = e.unknowns();
  if (e.kind == Kind::allen_cahn) {
    std::copy_n(z, n, dz);
    return add_laplacian(e, e.stiffness, z, dz);
  }
  if (e.kind == Kind::cahn_hilliard) {
    double* w = flux_.data();
    for (std::size_t j = 0; j < n; ++j) w[j] = -z[j];
    add_laplacian(e, -e.stiffness, z, w);
    std::fill_n(dz, n, 0.0);
    return add_laplacian(e, 1, w, dz);
  }
  if (e.kind == Kind::gkdv) {
    double* w = flux_.data() + 1;
    const double a = -e.stiffness / (e.dx * e.dx);
    const RowLaplacian laplacian{n, z, nullptr, nullptr};
    laplacian([=](std::size_t j, double sum) { w[j] = a * sum; });
    flux_[0] = w[n - 1];
    flux_[n + 1] = w[0];
    const double* f = flux_.data();
    for (std::size_t j = 0; j < n; ++j) dz[j] = (f[j + 2] - f[j]) / (2 * e.dx) - e.gamma * z[j];
    return;
  }
  std::copy_n(z + n, n, dz);
  for (std::size_t j = 0; j < n; ++j) dz[n + j] = -e.mass_squared * z[j] - e.gamma * z[n + j];
  add_laplacian(e, e.stiffness, z, dz + n);
  if (e.beta != 0) add_laplacian(e, e.beta, z + n, dz + n);
}

void RightHandSide::nonlinear(const double* z, double* dz) const {
  const Equation& e = equation_;
  const std::size_t n = e.unknowns();
  double* out = e.is_second_order() ? dz + n : dz;
  if (e.is_second_order()) std::fill_n(dz, n, 0.0);
  switch (e.kind) {
    case Kind::klein_gordon:
      for (std::size_t j = 0; j < n; ++j) out[j] = -e.strength * z[j] * z[j] * z[j];
      return;
    case Kind::alpha_fpu: {
      double* s = flux_.data();
      s[0] = z[0] * z[0];
      for (std::size_t j = 1; j < n; ++j) s[j] = (z[j] - z[j - 1]) * (z[j] - z[j - 1]);
      s[n] = z[n - 1] * z[n - 1];
      const double c = e.strength / (2 * e.dx * e.dx * e.dx);
      for (std::size_t j = 0; j < n; ++j) out[j] = c * (s[j + 1] - s[j]);
      return;
    }
    case Kind::gkdv: {
      const double c = -e.strength / (2 * e.dx);
      const auto difference = [=](std::size_t before, std::size_t after) {
        return c * (z[after] * z[after] - z[before] * z[before]);
      };
      out[0] = difference(n - 1, 1);
      for (std::size_t j = 1; j + 1 < n; ++j) out[j] = difference(j - 1, j + 1);
      out[n - 1] = difference(n - 2, 0);
      return;
    }
    case Kind::allen_cahn:
      for (std::size_t j = 0; j < n; ++j) out[j] = -z[j] * z[j] * z[j];
      return;
    case Kind::cahn_hilliard: {
      double* w = flux_.data();
      for (std::size_t j = 0; j < n; ++j) w[j] = z[j] * z[j] * z[j];
      std::fill_n(out, n, 0.0);
      return add_laplacian(e, 1, w, out);
    }
  }
}

// The nonlinear part is homogeneous and polynomial, so its derivative follows from z and w in one pass.
void RightHandSide::jacobian(const double* z, const double* w, double* jw) const {
  const Equation& e = equation_;
  const std::size_t n = e.unknowns();
  linear(w, jw);
  switch (e.kind) {
    case Kind::klein_gordon:
      for (std::size_t j = 0; j < n; ++j) jw[n + j] -= 3 * e.strength * z[j] * z[j] * w[j];
      return;
    case Kind::alpha_fpu: {
      double* s = flux_.data();
      s[0] = z[0] * w[0];
      for (std::size_t j = 1; j < n; ++j) s[j] = (z[j] - z[j - 1]) * (w[j] - w[j - 1]);
      s[n] = z[n - 1] * w[n - 1];
      const double c = e.strength / (e.dx * e.dx * e.dx);
      for (std::size_t j = 0; j < n; ++j) jw[n + j] += c * (s[j + 1] - s[j]);
      return;
    }
    case Kind::gkdv: {
      const double c = -e.strength / e.dx;
      for (std::size_t j = 0; j < n; ++j) {
        const std::size_t before = j == 0 ? n - 1 : j - 1;
        const std::size_t after = j + 1 == n ? 0 : j + 1;
        jw[j] += c * (z[after] * w[after] - z[before] * w[before]);
      }
      return;
    }
    case Kind::allen_cahn:
      for (std::size_t j = 0; j < n; ++j) jw[j] -= 3 * z[j] * z[j] * w[j];
      return;
    case Kind::cahn_hilliard: {
      double* s = flux_.data();
      for (std::size_t j = 0; j < n; ++j) s[j] = 3 * z[j] * z[j] * w[j];
      return add_laplacian(e, 1, s, jw);
    }
  }
}

}  // namespace seiche::bench
