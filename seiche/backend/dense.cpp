#include <seiche/backend/dense.hpp>
#include <seiche/backend/force_map.hpp>
#include <seiche/backend/grid_damping.hpp>
#include <seiche/backend/grid_potential.hpp>
#include <seiche/backend/grid_space.hpp>
#include <seiche/core/error.hpp>

namespace seiche {
namespace {

using Matrix = Eigen::MatrixXd;

class DenseMap final : public LinearMap {
 public:
  explicit DenseMap(Matrix a) : a_(std::move(a)) {}
  void apply(const Vector& in, Vector& out) const override { out.noalias() = a_ * in; }

 private:
  Matrix a_;
};

class DensePropagator final : public Propagator {
 public:
  DensePropagator(const ForceMaps<Matrix>& maps, const Matrix& M)
      : F_(maps.F), FM_(maps.F * M), Q_(maps.Q), QM_(maps.Q * M) {}

  void predict(const Vector& z, const Vector& gradient, Vector& z_mid) const override {
    z_mid = z;
    z_mid.noalias() += QM_ * z;
    z_mid.noalias() += Q_ * gradient;
  }
  void increment(const Vector& z, Vector& dz) const override { dz.noalias() = FM_ * z; }
  void force(const Vector& f, Vector& q) const override { q.noalias() = F_ * f; }

 private:
  Matrix F_, FM_, Q_, QM_;
};

class DenseLinear final : public LinearPart {
 public:
  DenseLinear(Matrix S, Matrix M)
      : S_(std::move(S)), M_(std::move(M)), absolute_M_(M_.cwiseAbs()), scratch_(M_.rows()) {}

  void apply_S(const Vector& z, Vector& out) const override { out.noalias() = S_ * z; }
  void apply_M(const Vector& z, Vector& out) const override { out.noalias() = M_ * z; }
  double quadratic_energy(const Vector& z) const override {
    scratch_.noalias() = M_ * z;
    return z.dot(scratch_) / 2;
  }
  double quadratic_magnitude(const Vector& z) const override {
    scratch_.noalias() = absolute_M_ * z.cwiseAbs();
    return z.cwiseAbs().dot(scratch_) / 2;
  }
  std::unique_ptr<Propagator> propagator(PropagatorKind kind, double h) const override {
    return std::make_unique<DensePropagator>(force_maps(kind, S_, M_, h), M_);
  }

 private:
  Matrix S_, M_, absolute_M_;
  mutable Vector scratch_;
};

}  // namespace

System dense_system(const Problem& problem, const BackendOptions&) {
  const Index n = problem.grid.unknowns();
  if (problem.size() > dense_limit) {
    throw Error("the dense backend takes up to {} unknowns and {} has {}; use backend \"modal\"", dense_limit,
                problem.name, problem.size());
  }
  const std::shared_ptr<const FieldTransform> identity = identity_transform(n);
  System system;
  system.space = std::make_unique<GridSpace>(problem.field_count(), identity);
  const auto matrix = [&](const BlockStencil& stencil, SparseMatrix SparseOperators::*sparse) -> Matrix {
    return problem.matrices ? Matrix((*problem.matrices).*sparse) : stencil.matrix(problem.grid);
  };
  system.linear =
      std::make_unique<DenseLinear>(matrix(problem.S, &SparseOperators::S), matrix(problem.M, &SparseOperators::M));
  system.potential = std::make_unique<GridPotential>(problem, identity);

  std::unique_ptr<LinearMap> constant;
  GridDamping::MakeFlow make_flow;
  const Matrix D = matrix(problem.damping.constant, &SparseOperators::D);
  if (!D.isZero(0)) {
    constant = std::make_unique<DenseMap>(D);
    make_flow = [D](double h) { return std::make_unique<DenseMap>(damping_exponential(D, h)); };
  }
  system.damping = std::make_unique<GridDamping>(problem, n, std::move(constant), std::move(make_flow));
  system.initial = problem.initial;
  return system;
}

}  // namespace seiche
