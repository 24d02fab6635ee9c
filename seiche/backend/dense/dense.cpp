#include <seiche/backend/dense/dense.hpp>
#include <seiche/backend/dense/dense_force.hpp>
#include <seiche/backend/dense/dense_phi.hpp>
#include <seiche/backend/dense/lane_matrix.hpp>
#include <seiche/backend/grid/beyond_linear.hpp>
#include <seiche/backend/grid/grid_damping.hpp>
#include <seiche/backend/grid/grid_potential.hpp>
#include <seiche/backend/grid/grid_space.hpp>
#include <seiche/backend/phi/force_map.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/noise/fluctuation.hpp>

#include <algorithm>
#include <cmath>

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

// ½zᵀMz, at the cost of the part of M that is not the identity.
class DenseMetric {
 public:
  explicit DenseMetric(const Matrix& M) : size_(M.rows()), leading_(M.rows()) {
    while (leading_ > 0 && is_unit(M, leading_ - 1)) --leading_;
    M_ = LaneMatrix(M.topLeftCorner(leading_, leading_));
    Mz_.resize(M_.padded_rows());
  }
  template <class Z>
  double energy(const Z& z) const {  // of the first size_ numbers of z
    M_.apply(z.data(), Mz_.data());
    return (z.head(leading_).dot(Mz_.head(leading_)) + z.segment(leading_, size_ - leading_).squaredNorm()) / 2;
  }

 private:
  static bool is_unit(const Matrix& M, Index i) {
    return M(i, i) == 1 && M.row(i).cwiseAbs().sum() == 1 && M.col(i).cwiseAbs().sum() == 1;
  }
  Index size_, leading_;  // rows and columns from leading_ on are those of the identity
  LaneMatrix M_;
  mutable Vector Mz_;
};

class DensePropagator final : public Propagator {
 public:
  // `metric` outlives the propagator.
  DensePropagator(const DenseForce& maps, const DenseMetric& metric, Potential::Support support)
      : size_(maps.F.rows()),
        support_(support),
        metric_(metric),
        all_F_(maps.F),
        F_(maps.F.middleCols(support.begin, support.size)),
        FM_(maps.FM),
        in_energy_(maps.T.size() > 0) {
    Matrix mid(support.size, size_ + support.size);
    if (in_energy_) {
      T_ = LaneMatrix(maps.T);
      y_.resize(T_.padded_rows());
      const Matrix rows = maps.T.middleRows(support.begin, support.size);
      mid << rows * maps.QM, rows * maps.Q.middleCols(support.begin, support.size);
    } else {
      mid << maps.QM.middleRows(support.begin, support.size),
          maps.Q.block(support.begin, support.begin, support.size, support.size);
    }
    mid_ = LaneMatrix(mid);
    of_gradient_ = LaneMatrix(mid.rightCols(support.size));
    z_and_gradient_.resize(size_ + support.size);
    difference_.resize(support.size);
    for (Vector* v : {&dz_, &q_}) v->resize(std::max(FM_.padded_rows(), mid_.padded_rows()));
  }

  // ẑ = z⁻ + Q(Mz⁻ + ∇V), as one matrix times (z⁻, ∇V)
  void predict(const Vector& z, const Vector& gradient, Vector& z_mid, FieldFactors before) const override {
    set(z, before);
    z_and_gradient_.tail(support_.size) = of_support(gradient);
    move_to_midpoint(z_mid);
  }
  bool recall(const Vector& z, const Gradients& g, Vector& z_mid, FieldFactors before,
              Recalled& recalled) const override {
    set(z, before);
    difference_ = of_support(g.g0) - of_support(g.g1);
    z_and_gradient_.tail(support_.size) = of_support(g.g0) + g.weight * difference_;
    move_to_midpoint(z_mid);
    recalled.moved = q_.head(support_.size).squaredNorm();
    difference_ -= g.ratio * (of_support(g.g1) - of_support(g.g2));
    of_gradient_.apply(difference_.data(), q_.data());
    recalled.missed = q_.head(support_.size).squaredNorm();
    return true;
  }
  void increment(const Vector& z, Vector& dz) const override {
    FM_.apply(z.data(), dz_.data());
    to_state(dz_);
    dz = dz_.head(size_);
  }
  void force(const Vector& f, Vector& q) const override {
    if (!in_energy_) {
      q.noalias() = all_F_ * f;
      return;
    }
    q_.head(size_).noalias() = all_F_ * f;
    to_state(q_);
    q = q_.head(size_);
  }

  Powers powers(const Vector& z, const Vector& f, FieldFactors before) const override {
    set(z, before);
    FM_.apply(z_and_gradient_.data(), dz_.data());
    F_.apply(f.data() + support_.begin, q_.data());
    to_state(dz_);
    to_state(q_);
    return {of_support(f).dot(of_support(dz_)), of_support(f).dot(of_support(q_)), metric_.energy(z_and_gradient_)};
  }
  void update(Vector& z, const Vector& /*f*/, double c, FieldFactors /*before*/, FieldFactors after) const override {
    z = z_and_gradient_.head(size_) + dz_.head(size_) + c * q_.head(size_);
    multiply_fields(after, z);
  }

 private:
  Eigen::VectorBlock<const Vector> of_support(const Vector& v) const {
    return v.segment(support_.begin, support_.size);
  }

  // ẑ from z⁻ and a gradient; ẑ − z⁻ stays in q.
  void move_to_midpoint(Vector& z_mid) const {
    mid_.apply(z_and_gradient_.data(), q_.data());
    z_mid.segment(support_.begin, support_.size) = of_support(z_and_gradient_) + q_.head(support_.size);
  }

  void set(const Vector& z, FieldFactors before) const {
    const Index slots = before.empty() ? 0 : size_ / static_cast<Index>(before.size());
    if (before.empty()) z_and_gradient_.head(size_) = z;
    for (std::size_t f = 0; f < before.size(); ++f) {
      const Index begin = static_cast<Index>(f) * slots;
      z_and_gradient_.segment(begin, slots) = before[f] * z.segment(begin, slots);
    }
  }

  // From the coordinates of energy, if F and FM lead there.
  void to_state(Vector& v) const {
    if (!in_energy_) return;
    T_.apply(v.data(), y_.data());
    v.head(size_) = y_.head(size_);
  }

  Index size_;
  Potential::Support support_;
  const DenseMetric& metric_;
  Matrix all_F_;
  LaneMatrix F_, FM_, mid_, of_gradient_, T_;  // F_: the columns of forces
  bool in_energy_;
  mutable Vector z_and_gradient_, difference_, dz_, q_, y_;
};

class DenseLinear final : public LinearPart {
 public:
  DenseLinear(Matrix S, Matrix M, Potential::Support support)
      : support_(support),
        S_(std::move(S)),
        M_(std::move(M)),
        absolute_M_(M_.cwiseAbs()),
        metric_(M_),
        scratch_(M_.rows()),
        absolute_(M_.rows()) {}

  void apply_S(const Vector& z, Vector& out) const override { out.noalias() = S_ * z; }
  bool apply_symmetric_S(const Vector& z, Vector& out) const override {
    if (S_ == -S_.transpose()) return false;
    out.noalias() = 0.5 * S_ * z;
    out.noalias() += 0.5 * S_.transpose() * z;
    return true;
  }
  void apply_M(const Vector& z, Vector& out) const override { out.noalias() = M_ * z; }
  double quadratic_energy(const Vector& z) const override { return metric_.energy(z); }
  double quadratic_magnitude(const Vector& z) const override {
    absolute_ = z.cwiseAbs();  // a product with an expression would allocate
    scratch_.noalias() = absolute_M_ * absolute_;
    return absolute_.dot(scratch_) / 2;
  }
  std::unique_ptr<Propagator> propagator(PropagatorKind kind, double h) const override {
    return std::make_unique<DensePropagator>(dense_force(kind, S_, M_, h), metric_, support_);
  }

 private:
  Potential::Support support_;
  Matrix S_, M_, absolute_M_;
  DenseMetric metric_;
  mutable Vector scratch_, absolute_;
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
