#include <seiche/method/closure/newton_krylov.hpp>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>
#include <unsupported/Eigen/IterativeSolvers>

#include <algorithm>
#include <cmath>

namespace seiche {

// The derivative of G at y as an operator for Eigen's GMRES: G'(y)w ≈ (G(y + sw) − G(y)) / s.
class DifferenceQuotient;

}  // namespace seiche

template <>
struct Eigen::internal::traits<seiche::DifferenceQuotient> : Eigen::internal::traits<Eigen::SparseMatrix<double>> {};

namespace seiche {

class DifferenceQuotient : public Eigen::EigenBase<DifferenceQuotient> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = false };

  DifferenceQuotient(const Residual& residual, const Vector& y, const Vector& at_y)
      : residual_(residual), y_(y), at_y_(at_y) {}
  Eigen::Index rows() const { return y_.size(); }
  Eigen::Index cols() const { return y_.size(); }

  template <class Rhs>
  Eigen::Product<DifferenceQuotient, Rhs, Eigen::AliasFreeProduct> operator*(const Eigen::MatrixBase<Rhs>& x) const {
    return {*this, x.derived()};
  }

  Vector times(const Vector& w) const {
    const double size = w.norm();
    if (size == 0) return Vector::Zero(w.size());
    const double s = std::sqrt(epsilon) * (1 + y_.norm()) / size;
    Vector moved(w.size());
    residual_(y_ + s * w, moved);
    return (moved - at_y_) / s;
  }

 private:
  const Residual& residual_;
  const Vector& y_;
  const Vector& at_y_;
};

}  // namespace seiche

template <class Rhs>
struct Eigen::internal::generic_product_impl<seiche::DifferenceQuotient, Rhs, Eigen::SparseShape, Eigen::DenseShape,
                                             Eigen::GemvProduct>
    : generic_product_impl_base<seiche::DifferenceQuotient, Rhs,
                                generic_product_impl<seiche::DifferenceQuotient, Rhs>> {
  using Scalar = typename Product<seiche::DifferenceQuotient, Rhs>::Scalar;
  template <class Dest>
  static void scaleAndAddTo(Dest& dst, const seiche::DifferenceQuotient& lhs, const Rhs& rhs, const Scalar& alpha) {
    dst.noalias() += alpha * lhs.times(rhs);
  }
};

namespace seiche {

NewtonKrylovReport newton_krylov(const Residual& residual, Vector& y, double stagnation) {
  constexpr int max_newton = 30;
  constexpr int max_halvings = 12;
  NewtonKrylovReport report;
  Vector at_y(y.size());
  Vector trial(y.size());
  Vector at_trial(y.size());
  report.residual = residual(y, at_y);
  while (report.iterations < max_newton && report.residual > 1 && std::isfinite(report.residual)) {
    ++report.iterations;
    const DifferenceQuotient derivative(residual, y, at_y);
    Eigen::GMRES<DifferenceQuotient, Eigen::IdentityPreconditioner> gmres;
    gmres.set_restart(static_cast<int>(std::min<Index>(y.size(), 60)));
    gmres.setTolerance(1e-6);
    gmres.setMaxIterations(static_cast<int>(std::min<Index>(y.size(), 60)));
    gmres.compute(derivative);
    const Vector direction = gmres.solve(at_y);
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
