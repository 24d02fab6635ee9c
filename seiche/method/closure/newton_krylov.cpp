#include <seiche/method/closure/gmres.hpp>
#include <seiche/method/closure/newton_krylov.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {

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
