#include <seiche/backend/dense/dense.hpp>
#include <seiche/backend/reference/long_matrix.hpp>
#include <seiche/backend/reference/reference.hpp>
#include <seiche/backend/reference/reference_phi.hpp>
#include <seiche/backend/reference/reference_terms.hpp>

#include <Eigen/LU>

namespace seiche {
namespace {

using Matrix = Eigen::MatrixXd;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

// F of z⁺ = (I + FM)z + Ff, by the formulas above Propagator.
LongMatrix reference_force(PropagatorKind kind, const LongMatrix& S, const LongMatrix& M, long double h) {
  const LongMatrix A = h * (S * M);
  if (kind == PropagatorKind::exponential) return h * (reference_phi_functions(A, 1)[1] * S);
  const LongMatrix left = long_identity(S.rows()) - A / 2;
  return h * left.fullPivLu().solve(S);
}

class ReferencePropagator final : public PlainPropagator {
 public:
  ReferencePropagator(const Space& space, const LinearPart& linear, PropagatorKind kind, const LongMatrix& S,
                      const LongMatrix& M, double h, Potential::Support support)
      : PlainPropagator(space, linear),
        F_(reference_force(kind, S, M, h)),
        FM_(F_ * M),
        Q_(kind == PropagatorKind::cayley ? LongMatrix(F_ / 2) : reference_force(kind, S, M, h / 2)),
        QM_(Q_ * M),
        support_(support),
        f_(Vector::Zero(space.size())),
        x_(space.size()),
        y_(space.size()) {}

  void increment(const Vector& z, Vector& dz) const override { product(FM_, z, dz); }
  void force(const Vector& f, Vector& q) const override { product(F_, f, q); }
  // ẑ = z⁻ + Q(Mz⁻ + ∇V)
  void predict(const Vector& z, const Vector& gradient, Vector& z_mid, FieldFactors before) const override {
    const auto [begin, size] = support_;
    z_ = z;
    multiply_fields(before, z_);
    f_.segment(begin, size) = gradient.segment(begin, size);
    product(QM_, z_, dz_);
    product(Q_, f_, q_);
    z_mid.segment(begin, size) = (z_ + dz_ + q_).segment(begin, size);
  }

 private:
  void product(const LongMatrix& a, const Vector& x, Vector& out) const {
    x_ = x.cast<long double>();
    y_.noalias() = a * x_;
    out = y_.cast<double>();
  }

  LongMatrix F_, FM_, Q_, QM_;  // Q: F of half a step, for the predictor
  Potential::Support support_;
  mutable Vector z_, f_, dz_, q_;
  mutable LongVector x_, y_;
};

class ReferenceLinear final : public LinearPart {
 public:
  ReferenceLinear(const Space& space, Potential::Support support, Matrix S, Matrix M)
      : space_(space), support_(support), S_(std::move(S)), M_(std::move(M)), absolute_M_(M_.cwiseAbs()) {}

  void apply_S(const Vector& z, Vector& out) const override { out.noalias() = S_ * z; }
  bool apply_symmetric_S(const Vector& z, Vector& out) const override {
    if (S_ == -S_.transpose()) return false;
    out.noalias() = 0.5 * (S_ + S_.transpose()) * z;
    return true;
  }
  void apply_M(const Vector& z, Vector& out) const override { out.noalias() = M_ * z; }
  double quadratic_energy(const Vector& z) const override {
    Mz_.noalias() = M_ * z;
    return space_.dot(z, Mz_) / 2;
  }
  double quadratic_magnitude(const Vector& z) const override {
    size_ = z.cwiseAbs();
    Mz_.noalias() = absolute_M_ * size_;
    return space_.dot(size_, Mz_) / 2;
  }
  std::unique_ptr<Propagator> propagator(PropagatorKind kind, double h) const override {
    return std::make_unique<ReferencePropagator>(space_, *this, kind, S_.cast<long double>(), M_.cast<long double>(), h,
                                                 support_);
  }

 private:
  const Space& space_;
  Potential::Support support_;
  Matrix S_, M_, absolute_M_;
  mutable Vector size_, Mz_;
};

}  // namespace

System reference_system(const Problem& problem, const BackendOptions& options) {
  System system = dense_system(problem, options);
  const auto matrix = [&](const BlockStencil& stencil, SparseMatrix SparseOperators::*sparse) -> Matrix {
    return problem.matrices ? Matrix((*problem.matrices).*sparse) : stencil.matrix(problem.grid);
  };
  const Matrix S = matrix(problem.S, &SparseOperators::S);
  const Matrix M = matrix(problem.M, &SparseOperators::M);
  const Matrix C = matrix(problem.damping.constant, &SparseOperators::D);
  Matrix D0 = C;
  const Index n = problem.grid.unknowns();
  for (std::size_t f = 0; f < problem.damping.rate_fields.size(); ++f)
    if (problem.damping.rate_fields[f])
      D0.diagonal().segment(static_cast<Index>(f) * n, n).array() += rate_of_D0(problem);

  if (problem.potential) system.potential = reference_potential(problem);
  const Potential::Support support = system.potential->support();
  system.linear = std::make_unique<ReferenceLinear>(*system.space, support, S, M);
  system.damping = reference_damping(problem, C, std::move(system.damping));
  system.make_phi = [S, M, D0, support] { return reference_phi(S, M, D0, support); };
  system.make_undamped_phi = [S, M, support] { return reference_phi(S, M, Matrix::Zero(S.rows(), S.cols()), support); };
  return system;
}

}  // namespace seiche
