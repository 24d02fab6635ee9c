#include <seiche/core/control/stop_request.hpp>
#include <seiche/method/closure/gmres.hpp>

#include <Eigen/Jacobi>

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

}  // namespace seiche
