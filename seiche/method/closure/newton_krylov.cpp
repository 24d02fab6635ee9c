#include <seiche/core/control/stop_request.hpp>
#include <seiche/method/closure/newton_krylov.hpp>

#include <Eigen/Jacobi>

#include <algorithm>
#include <cmath>
#include <vector>

namespace seiche {

Vector gmres(const Space& space, FunctionRef<void(const Vector& w, Vector& out)> apply, const Vector& b, int most,
             double tolerance) {
  const double size = space.norm(b);
  Vector x = Vector::Zero(b.size());
  if (!(size > 0)) return x;
  std::vector<Vector> basis = {b / size};
  std::vector<Eigen::JacobiRotation<double>> rotations;
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(most + 1, most);  // of the Hessenberg matrix QᵀAQ
  Vector residual = Vector::Zero(most + 1);
  residual[0] = size;

  int n = 0;
  while (n < most && std::abs(residual[n]) > tolerance * size) {
    end_if_asked();
    Vector w(b.size());
    apply(basis.back(), w);
    auto column = R.col(n);
    for (int i = 0; i <= n; ++i) {  // Gram and Schmidt, one after the other
      column[i] = space.dot(basis[static_cast<std::size_t>(i)], w);
      w -= column[i] * basis[static_cast<std::size_t>(i)];
    }
    const double left = column[n + 1] = space.norm(w);
    for (int i = 0; i < n; ++i) column.applyOnTheLeft(i, i + 1, rotations[static_cast<std::size_t>(i)].adjoint());
    rotations.emplace_back().makeGivens(column[n], column[n + 1]);
    column.applyOnTheLeft(n, n + 1, rotations.back().adjoint());
    residual.applyOnTheLeft(n, n + 1, rotations.back().adjoint());
    ++n;
    if (!(left > 0)) break;  // the solution lies in the space; or it is not finite
    basis.emplace_back(w / left);
  }

  if (n > 0 && R(n - 1, n - 1) == 0) --n;  // a product that the space held already, and that adds nothing
  const Vector y = R.topLeftCorner(n, n).triangularView<Eigen::Upper>().solve(residual.head(n));
  for (int i = 0; i < n; ++i) x += y[i] * basis[static_cast<std::size_t>(i)];
  return x;
}

NewtonKrylovReport newton_krylov(const Space& space, const Residual& residual, Vector& y, double stagnation) {
  constexpr int max_newton = 30;
  constexpr int max_halvings = 12;
  const int most_products = static_cast<int>(std::min(space.sum(static_cast<double>(y.size())), 60.0));
  NewtonKrylovReport report;
  Vector at_y(y.size());
  Vector trial(y.size());
  Vector at_trial(y.size());
  report.residual = residual(y, at_y);
  while (report.iterations < max_newton && report.residual > 1 && std::isfinite(report.residual)) {
    ++report.iterations;
    // G'(y)w ≈ (G(y + sw) − G(y)) / s
    const double size_of_y = 1 + space.norm(y);
    const auto derivative = [&](const Vector& w, Vector& out) {
      const double s = std::sqrt(epsilon) * size_of_y / space.norm(w);
      trial = y + s * w;
      residual(trial, out);
      out = (out - at_y) / s;
    };
    const Vector direction = gmres(space, derivative, at_y, most_products, 1e-6);
    double length = 1;
    double size = 0;
    for (int i = 0; i <= max_halvings; ++i, length /= 2) {
      trial = y - length * direction;
      size = residual(trial, at_trial);
      if (size < report.residual) break;
    }
    if (!(size < report.residual)) break;
    y.swap(trial);
    at_y.swap(at_trial);
    report.residual = size;
  }
  report.converged = report.residual <= stagnation;
  return report;
}

}  // namespace seiche
