#include <seiche/backend/dense/dense.hpp>
#include <seiche/backend/dense/dense_force.hpp>
#include <seiche/backend/dense/dense_phi.hpp>
#include <seiche/backend/dense/dense_propagator.hpp>
#include <seiche/backend/grid/beyond_linear.hpp>
#include <seiche/backend/grid/grid_damping.hpp>
#include <seiche/backend/grid/grid_potential.hpp>
#include <seiche/backend/grid/grid_space.hpp>
#include <seiche/backend/phi/force_map.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/noise/fluctuation.hpp>

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

class DenseLinear final : public LinearPart {
 public:
  DenseLinear(Matrix S, Matrix M, Potential::Support support)
      : support_(support),
        S_(std::move(S)),
        M_(std::move(M)),
        metric_(M_),
        absolute_metric_(M_.cwiseAbs()),
        absolute_(M_.rows()) {
    if (S_ != -S_.transpose()) symmetric_S_ = (S_ + S_.transpose()) / 2;
  }

  void apply_S(const Vector& z, Vector& out) const override { out.noalias() = S_ * z; }
  bool apply_symmetric_S(const Vector& z, Vector& out) const override {
    if (symmetric_S_.size() == 0) return false;
    out.noalias() = symmetric_S_ * z;
    return true;
  }
  void apply_M(const Vector& z, Vector& out) const override { out.noalias() = M_ * z; }
  double quadratic_energy(const Vector& z) const override { return metric_.energy(z.data()); }
  double quadratic_magnitude(const Vector& z) const override {
    absolute_ = z.cwiseAbs();
    return absolute_metric_.energy(absolute_.data());
  }
  std::unique_ptr<Propagator> propagator(PropagatorKind kind, double h) const override {
    return dense_propagator(dense_force(kind, S_, M_, h), metric_, support_);
  }

 private:
  Potential::Support support_;
  Matrix S_, M_;
  Matrix symmetric_S_;  // empty: S is skew
  DenseMetric metric_, absolute_metric_;
  mutable Vector absolute_;
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
  system.fields = problem.field_count();
  system.space = std::make_unique<GridSpace>(problem.field_count(), identity);
  const auto matrix = [&](const BlockStencil& stencil, SparseMatrix SparseOperators::*sparse) -> Matrix {
    return problem.matrices ? Matrix((*problem.matrices).*sparse) : stencil.matrix(problem.grid);
  };
  system.potential =
      std::make_unique<GridPotential>(problem.potential, problem.potential_field, identity, *system.space);
  const Matrix S = matrix(problem.S, &SparseOperators::S);
  const Matrix M = matrix(problem.M, &SparseOperators::M);
  const Potential::Support support = system.potential->support();
  system.linear = std::make_unique<DenseLinear>(S, M, support);
  const Matrix D0 =
      problem.matrices ? Matrix(constant_damping_matrix(problem)) : constant_damping(problem).matrix(problem.grid);
  system.make_phi = [S, M, D0, support] { return dense_phi(S, M, D0, support); };
  system.make_undamped_phi = [S, M, support] { return dense_phi(S, M, Matrix::Zero(S.rows(), S.cols()), support); };

  system.make_noise = [S, M, D0](double h) {
    return std::make_unique<DenseMap>(fluctuation_root(dissipation(S, M, D0, !D0.isZero(0)), h));
  };

  std::unique_ptr<LinearMap> constant;
  GridDamping::MakeFlow make_flow;
  const Matrix D = matrix(problem.damping.constant, &SparseOperators::D);
  if (!D.isZero(0)) {
    constant = std::make_unique<DenseMap>(D);
    make_flow = [D](double h) { return std::make_unique<DenseMap>(damping_exponential(D, h)); };
  }
  system.damping = std::make_unique<GridDamping>(problem, n, std::move(constant), std::move(make_flow));
  add_beyond_linear(system, problem, identity,
                    [&](const Stencil& d) { return std::make_unique<DenseMap>(d.matrix(problem.grid)); });
  system.initial = problem.initial;
  return system;
}

}  // namespace seiche
