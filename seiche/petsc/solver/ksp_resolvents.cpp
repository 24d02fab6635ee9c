#include <seiche/core/base/error.hpp>
#include <seiche/petsc/solver/ksp_resolvents.hpp>
#include <seiche/petsc/solver/presb.hpp>

#include <optional>
#include <vector>

namespace seiche {
namespace {

using OwnedKsp = PetscHandle<KSP, KSPDestroy>;

template <class Object>
bool is_of_type(Object object, const char* type) {
  PetscBool is = PETSC_FALSE;
  require(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(object), type, &is));
  return is == PETSC_TRUE;
}

bool is_direct(KSP ksp) {
  PC pc = nullptr;
  require(KSPGetPC(ksp, &pc));
  return is_of_type(ksp, KSPPREONLY) &&
         (is_of_type(pc, PCLU) || is_of_type(pc, PCCHOLESKY) || is_of_type(pc, PCREDUNDANT));
}

bool asks_for_presb(const SolverOptions& options) { return options.is_true("-presb"); }

// Without the preconditioner Presb, which belongs to one pole.
void make_solver(MPI_Comm communicator, const SolverOptions& options, KspResolvents::Tolerance tolerance,
                 OwnedKsp& ksp) {
  require(KSPCreate(communicator, ksp.make()));
  options.give_to(ksp);
  require(KSPSetType(ksp, KSPPREONLY));
  PC pc = nullptr;
  require(KSPGetPC(ksp, &pc));
  require(PCSetType(pc, PCLU));
  int processes = 1;
  MPI_Comm_size(communicator, &processes);
  if (processes > 1) require(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  require(KSPSetFromOptions(ksp));
  if (asks_for_presb(options)) {
    if (options.has("-pc_type"))
      throw Error("{} and {} are two preconditioners: leave one of them out", options.written("-presb"),
                  options.written("-pc_type"));
    require(PCSetType(pc, PCSHELL));
  }
  if (is_direct(ksp)) return;
  if (is_of_type(static_cast<KSP>(ksp), KSPPREONLY)) {
    if (options.has("-ksp_type"))
      throw Error(
          "{} preonly with a preconditioner that is no factorisation solves nothing: leave it out, or write {} lu",
          options.written("-ksp_type"), options.written("-pc_type"));
    require(KSPSetType(ksp, KSPGMRES));
    require(KSPSetFromOptions(ksp));
  }
  if (tolerance == KspResolvents::Tolerance::round_off)
    require(KSPSetTolerances(ksp, 1e-14, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
}

class KspResolvent final : public Resolvent {
 public:
  KspResolvent(Mat B, double h, std::complex<double> p, SolverOptions options, Index first,
               KspResolvents::Tolerance tolerance, std::int64_t& iterations)
      : p_(p), options_(std::move(options)), iterations_(iterations) {
    const MPI_Comm communicator = communicator_of(B);
    make_shifted(B, h, p, shifted_);
    make_solver(communicator, options_, tolerance, ksp_);
    if (asks_for_presb(options_)) {
      PC pc = nullptr;
      require(KSPGetPC(ksp_, &pc));
      presb_.emplace(B, h, p, first, options_);
      presb_->attach(pc);
    }
    require(KSPSetOperators(ksp_, shifted_, shifted_));
    require(KSPSetUp(ksp_));
    require(KSPSetUpOnBlocks(ksp_));
    if (tolerance == KspResolvents::Tolerance::of_options) options_.require_known();
    const Index size = local_rows(shifted_);
    for (BorrowedVec* v : {&right_, &solution_}) v->set_layout(communicator, size);
    if (p.imag() == 0) return;
    pairs_.setZero(size);
    solved_.setZero(size);
  }

  void apply(const Vector& b, Vector& x) const override {
    if (p_.imag() == 0) return solve(b, x);
    for (Index i = 0; i < b.size(); ++i) pairs_[2 * i] = b[i];
    solve(pairs_, solved_);
    for (Index i = 0; i < b.size(); ++i) x[i] = solved_[2 * i + 1] / p_.imag();
  }

 private:
  void solve(const Vector& b, Vector& x) const {
    require(KSPSolve(ksp_, right_.of(span_of(b)), solution_.of(span_of(x))));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt iterations = 0;
    require(KSPGetConvergedReason(ksp_, &reason));
    require(KSPGetIterationNumber(ksp_, &iterations));
    iterations_ += iterations;
    if (reason > 0) return;
    PetscReal residual = 0;
    require(KSPGetResidualNorm(ksp_, &residual));
    throw Error(
        "the linear solver of the options {}… stopped after {} iterations with a residual of {:.3g} ({}); without them the "
        "solver is a factorisation",
        options_.written("-ksp_"), iterations, residual, KSPConvergedReasons[reason]);
  }

  std::complex<double> p_;
  SolverOptions options_;
  std::int64_t& iterations_;
  OwnedMat shifted_;
  std::optional<Presb> presb_;
  OwnedKsp ksp_;
  BorrowedVec right_, solution_;
  mutable Vector pairs_, solved_;
};

}  // namespace

std::unique_ptr<Resolvent> KspResolvents::make(double h, std::complex<double> pole) const {
  return std::make_unique<KspResolvent>(B_, h, pole, options_, first_, tolerance_, iterations_);
}

bool KspResolvents::iterates() const {
  OwnedKsp ksp;
  make_solver(communicator_of(B_), options_, tolerance_, ksp);
  if (!is_direct(ksp)) return true;
  options_.require_known("mat_");  // which factorisations look for
  return false;
}

}  // namespace seiche
