#include <seiche/backend/sparse/pade_propagator.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/spectral_radius.hpp>
#include <seiche/core/step_cache.hpp>
#include <seiche/petsc/ksp_resolvents.hpp>
#include <seiche/petsc/petsc_krylov.hpp>
#include <seiche/petsc/petsc_system.hpp>

#include <cmath>
#include <optional>

namespace seiche {
namespace {

// Rows side by side, those of each process in one array.
class RowSpace final : public Space {
 public:
  RowSpace(Index rows, const Ranks& ranks) : rows_(rows), ranks_(ranks) {}
  Index size() const override { return rows_; }
  Index physical_size() const override { return rows_; }
  void to_physical(const Vector& z, Vector& values) const override { values = z; }
  void from_physical(const Vector& values, Vector& z) const override { z = values; }
  using Space::max;
  using Space::sum;
  void sum(std::span<double> local) const override { ranks_.sum(local); }
  void max(std::span<double> local) const override { ranks_.max(local); }
  void add_units(const Units& units, std::span<const double> sums, std::span<double> totals) const override {
    Space::add_units(units, sums, totals);
    ranks_.sum(totals);
  }

 private:
  Index rows_;
  const Ranks& ranks_;
};

class PetscLinear final : public LinearPart {
 public:
  PetscLinear(const PetscEquation& equation, const Space& space, Potential::Support support,
              const SparseOptions& options)
      : space_(space), support_(support), options_(options), S_(equation.S), M_(equation.M) {
    multiply(equation.S, equation.M, SM_);
    radius_ = spectral_radius_bound(SM_);
    make_absolute(equation.M, absolute_M_itself_);
    absolute_M_.emplace(absolute_M_itself_);
    make_symmetric_part(equation.S, symmetric_S_itself_);
    if (!is_zero(symmetric_S_itself_)) symmetric_S_.emplace(symmetric_S_itself_);
    resolvents_.emplace(SM_);
    restores_ = !symmetric_S_ && resolvents_->iterates();
    for (Vector* v : {&image_, &sizes_}) v->resize(space.size());
  }

  void apply_S(const Vector& z, Vector& out) const override { S_.apply(z, out); }
  bool apply_symmetric_S(const Vector& z, Vector& out) const override {
    if (!symmetric_S_) return false;
    symmetric_S_->apply(z, out);
    return true;
  }
  void apply_M(const Vector& z, Vector& out) const override { M_.apply(z, out); }
  double quadratic_energy(const Vector& z) const override {
    M_.apply(z, image_);
    return space_.dot(z, image_) / 2;
  }
  double quadratic_magnitude(const Vector& z) const override {
    sizes_ = z.cwiseAbs();
    absolute_M_->apply(sizes_, image_);
    return space_.dot(sizes_, image_) / 2;
  }
  std::unique_ptr<Propagator> propagator(PropagatorKind kind, double h) const override {
    if (kind == PropagatorKind::cayley) return propagator(force(h, {1, 1}), nullptr);
    return propagator(force(h, plan(h)), force(h / 2, plan(h / 2)));
  }
  SolverShare solver_share() const { return {resolvents_->iterations(), moved_}; }

 private:
  std::unique_ptr<Propagator> propagator(std::unique_ptr<PadeForce> F, std::unique_ptr<PadeForce> Q) const {
    if (!restores_) return pade_propagator(M_, space_, support_, std::move(F), std::move(Q));
    return restoring_pade_propagator(M_, space_, support_, std::move(F), std::move(Q), moved_);
  }
  PadePlan plan(double h) const {
    constexpr double exponential_tolerance = 1e-14;
    if (options_.pade_degree > 0) return {options_.pade_degree, 1};
    return plan_pade(std::abs(h) * radius_, exponential_tolerance);
  }
  std::unique_ptr<PadeForce> force(double h, PadePlan plan) const {
    return std::make_unique<PadeForce>(S_, M_, space_.size(), *resolvents_, h, plan);
  }

  const Space& space_;
  Potential::Support support_;
  SparseOptions options_;
  PetscProduct S_, M_;
  OwnedMat SM_, absolute_M_itself_, symmetric_S_itself_;
  std::optional<PetscProduct> absolute_M_, symmetric_S_;
  std::optional<KspResolvents> resolvents_;
  double radius_ = 0.0;
  bool restores_ = false;
  mutable double moved_ = 0.0;
  mutable Vector image_, sizes_;
};

// A constant D; its flow by one exponential for each row where D is diagonal, and otherwise by that of S = −I, M = D.
class MatrixDamping final : public Damping {
 public:
  MatrixDamping(Mat D, const Space& space, Potential::Support support) : space_(space) {
    if (D == nullptr) return;
    PetscInt first = 0;
    require(MatGetOwnershipRange(D, &first, nullptr));
    bool is_diagonal = true, touches = false;
    diagonal_.setZero(space.size());
    visit_rows(D, [&](Index row, std::span<const PetscInt> columns, std::span<const double> values) {
      const Index here = row - first;
      for (std::size_t k = 0; k < columns.size(); ++k) {
        if (values[k] == 0) continue;
        touches = touches || (here >= support.begin && here < support.begin + support.size);
        if (columns[k] == row)
          diagonal_[here] = values[k];
        else
          is_diagonal = false;
      }
    });
    touches_potential_ = space.any(touches);
    D_.emplace(D);
    if (!space.any(!is_diagonal)) return;
    diagonal_.resize(0);
    require(MatDuplicate(D, MAT_COPY_VALUES, minus_D_.make()));
    require(MatScale(minus_D_, -1));
    minus_I_.emplace(D);
    resolvents_.emplace(minus_D_);
    radius_ = spectral_radius_bound(D);
  }

  bool is_zero() const override { return !D_; }
  bool touches_potential() const override { return touches_potential_; }
  bool is_constant() const override { return true; }
  void flow(double /*t*/, double h, Vector& z) const override {
    if (!D_) return;
    if (diagonal_.size() == z.size()) {
      z.array() *= factors(h).array();
      return;
    }
    image_.resize(z.size());
    moved_.resize(z.size());
    D_->apply(z, image_);
    flows_
        .at(h,
            [&] {
              return std::make_unique<PadeForce>(*minus_I_, *D_, z.size(), *resolvents_, h,
                                                 plan_pade(std::abs(h) * radius_, 1e-15));
            })
        .apply(image_, moved_);
    z += moved_;
  }
  void apply(double /*t*/, const Vector& z, Vector& out) const override { apply_D0(z, out); }
  void apply_rest(double /*t*/, const Vector& /*z*/, Vector& out) const override { out.setZero(); }
  void apply_D0(const Vector& z, Vector& out) const override {
    if (D_)
      D_->apply(z, out);
    else
      out.setZero();
  }
  double largest_rate(const Space& /*space*/, double /*t*/, double /*h*/, const Vector& /*before*/,
                      const Vector& /*after*/) const override {
    if (!rate_) {
      image_.resize(space_.size());
      rate_ = !D_ ? 0.0 : spectral_radius(space_, [this](Vector& z) {
        D_->apply(z, image_);
        z.swap(image_);
      });
    }
    return *rate_;
  }

 private:
  class MinusIdentity final : public Product {
   public:
    explicit MinusIdentity(Mat) {}
    void apply(std::span<const double> x, std::span<double> y) const override {
      for (std::size_t i = 0; i < x.size(); ++i) y[i] = -x[i];
    }
  };

  const Vector& factors(double h) const {
    if (h != factors_of_) {
      factors_ = (-h * diagonal_.array()).exp();
      factors_of_ = h;
    }
    return factors_;
  }

  const Space& space_;
  std::optional<PetscProduct> D_;
  Vector diagonal_;
  bool touches_potential_ = false;
  OwnedMat minus_D_;
  std::optional<MinusIdentity> minus_I_;
  std::optional<KspResolvents> resolvents_;
  double radius_ = 0.0;
  mutable StepCache<PadeForce> flows_;
  mutable std::optional<double> rate_;
  mutable double factors_of_ = 0.0;
  mutable Vector factors_, image_, moved_;
};

}  // namespace

void require_hypotheses(const PetscEquation& equation) {
  OwnedMat skew;
  make_symmetric_part(equation.M, skew);
  add(-1, equation.M, skew);
  PetscReal asymmetry = 0, size = 0;
  require(MatNorm(skew, NORM_INFINITY, &asymmetry));
  require(MatNorm(equation.M, NORM_INFINITY, &size));
  if (!(asymmetry <= 4 * epsilon * size))
    throw Error("M must be symmetric and finite, but it differs from its transpose by {:.3g} in the sum of a row",
                2 * asymmetry);
  if (sign_of(equation.M) == Sign::negative)
    throw Error("M must be positive semidefinite, and there is a direction z with zᵀMz < 0");
}

void merge_damping(PetscEquation& equation, Potential::Support support, const std::string& method, OwnedMat& S_less_D) {
  OwnedMat DM;
  PetscInt first = 0;
  multiply(equation.D, equation.M, DM);
  add(-1, equation.D, DM);
  require(MatGetOwnershipRange(equation.D, &first, nullptr));
  // Columns of D that V depends on: those that D takes from ones in the support.
  Vector ones = Vector::Zero(local_rows(equation.D)), image = ones;
  ones.segment(support.begin, support.size).setOnes();
  OwnedMat sizes;
  make_absolute(equation.D, sizes);
  PetscProduct(sizes).apply(ones, image);
  double sees_V = image.size() > 0 ? image.lpNorm<Eigen::Infinity>() : 0.0;
  equation.ranks->max({&sees_V, 1});
  if (!is_zero(DM) || sees_V != 0)
    throw Error(
        "{} does not apply: a method that merges the damping into S needs Dz = D∇H(z), and here it is not; methods that "
        "split the damping off (savf, seavf, seisav, seilm, …) and egc2 … egc8 take it",
        method);
  require(MatDuplicate(equation.S, MAT_COPY_VALUES, S_less_D.make()));
  add(-1, equation.D, S_less_D);
  equation.S = S_less_D;
  equation.D = nullptr;
}

LawPromise promise_energy_law(const PetscEquation& equation, Potential::Support support, const Space& space) {
  LawPromise law;
  OwnedMat feeding;  // −sym(S)
  make_symmetric_part(equation.S, feeding);
  require(MatScale(feeding, -1));
  const bool is_skew = is_zero(feeding);
  if (!is_skew && sign_of(feeding) != Sign::nonnegative) {
    law.reason = "sym(S) ⪯ 0 fails, or is not known";
    return law;
  }
  if (equation.D != nullptr) {
    if (space.any(has_entries(equation.D, support))) {
      law.reason = "the damping acts on components that V depends on, and may raise V";
      return law;
    }
    OwnedMat MD, part;
    multiply(equation.M, equation.D, MD);
    make_symmetric_part(MD, part);
    if (sign_of(part) != Sign::nonnegative) {
      law.reason = "sym(MD) ⪰ 0 fails, or is not known";
      return law;
    }
  }
  law.promised = law.never_grows = true;
  law.never_changes = is_skew && equation.D == nullptr;
  law.reason = equation.D != nullptr ? "sym(MD) ⪰ 0 and V does not depend on the damped components"
                                     : "sym(S) ⪯ 0 and no damping flow";
  return law;
}

SolverShare solver_share(const System& system) {
  return dynamic_cast<const PetscLinear&>(*system.linear).solver_share();
}

System petsc_system(const PetscEquation& equation, Potential::Support support, const SparseOptions& options) {
  System system;
  system.space = std::make_unique<RowSpace>(local_rows(equation.M), *equation.ranks);
  const Space& space = *system.space;
  system.linear = std::make_unique<PetscLinear>(equation, space, support, options);
  system.damping = std::make_unique<MatrixDamping>(equation.D, space, support);
  system.make_phi = [equation, support, &space] { return petsc_phi(equation, support, space); };
  system.make_undamped_phi = [equation = PetscEquation{equation.S, equation.M, nullptr, equation.ranks}, support,
                              &space] { return petsc_phi(equation, support, space); };
  return system;
}

}  // namespace seiche
