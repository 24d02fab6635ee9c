#include <seiche/backend/sparse/pade_propagator.hpp>
#include <seiche/petsc/petsc_krylov.hpp>
#include <seiche/petsc/petsc_lanczos.hpp>
#include <seiche/petsc/petsc_system.hpp>
#include <seiche/petsc/solver/ksp_resolvents.hpp>

#include <cmath>
#include <optional>

namespace seiche {
namespace {

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
  PetscLinear(const PetscEquation& equation, const Space& space, Potential::Support support, SparseOptions options)
      : space_(space), support_(support), options_(std::move(options)), S_(equation.S), M_(equation.M) {
    multiply(equation.S, equation.M, SM_);
    radius_ = spectral_radius_bound(SM_);
    make_absolute(equation.M, absolute_M_itself_);
    absolute_M_.emplace(absolute_M_itself_);
    make_symmetric_part(equation.S, symmetric_S_itself_);
    if (!is_zero(symmetric_S_itself_)) symmetric_S_.emplace(symmetric_S_itself_);
    resolvents_.emplace(SM_, equation.solver, support.size);
    if (options_.exponential == ExponentialKind::lanczos && symmetric_S_) throw lanczos_needs_skew_S();
    if (options_.exponential == ExponentialKind::lanczos)
      skew_ = std::make_shared<PetscSkewSystem>(equation, S_, M_, space_);
    iterates_ = resolvents_->iterates();
    if (iterates_ && radius_ > 0 && !options_.solver.empty() && !skew_)
      resolvents_->make(1 / radius_, {1, 1});  // says now what is wrong with the options of a case
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
    if (skew_) return lanczos_propagator(skew_, support_, h, options_.lanczos_dimension, iterates_ ? &moved_ : nullptr);
    return propagator(force(h, plan(h)), force(h / 2, plan(h / 2)));
  }
  std::optional<SolverShare> solver_share() const override {
    if (!iterates_) return {};
    return SolverShare{.iterations = resolvents_->iterations() + (skew_ ? skew_->iterations() : 0), .restored = moved_};
  }

 private:
  std::unique_ptr<Propagator> propagator(std::unique_ptr<PadeForce> F, std::unique_ptr<PadeForce> Q) const {
    if (!iterates_ || symmetric_S_) return pade_propagator(M_, space_, support_, std::move(F), std::move(Q));
    return restoring_pade_propagator(M_, space_, support_, std::move(F), std::move(Q), moved_);
  }
  PadePlan plan(double h) const { return plan_exponential(std::abs(h) * radius_, options_); }
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
  std::shared_ptr<const PetscSkewSystem> skew_;  // null: Padé
  double radius_ = 0.0;
  bool iterates_ = false;
  mutable double moved_ = 0.0;
  mutable Vector image_, sizes_;
};

}  // namespace

std::unique_ptr<Space> row_space(Index rows, const Ranks& ranks) { return std::make_unique<RowSpace>(rows, ranks); }

System petsc_system(const PetscEquation& equation, std::unique_ptr<Space> of_states, Potential::Support support,
                    const SparseOptions& options) {
  System system;
  system.space = std::move(of_states);
  const Space& space = *system.space;
  system.linear = std::make_unique<PetscLinear>(equation, space, support, options);
  system.make_phi = [equation, support, &space] { return petsc_phi(equation, support, space); };
  PetscEquation undamped = equation;
  undamped.D = nullptr;
  system.make_undamped_phi = [undamped, support, &space] { return petsc_phi(undamped, support, space); };
  return system;
}

}  // namespace seiche
