#include <seiche/core/base/error.hpp>
#include <seiche/petsc/ksp_resolvents.hpp>

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

// hB − p, or the real system of twice the size: the two parts of each unknown side by side.
void make_shifted(Mat B, double h, std::complex<double> p, OwnedMat& shifted) {
  const PetscInt parts = p.imag() == 0 ? 1 : 2;
  const auto rows = static_cast<PetscInt>(local_rows(B)) * parts;
  require(MatCreate(communicator_of(B), shifted.make()));
  require(MatSetSizes(shifted, rows, rows, PETSC_DETERMINE, PETSC_DETERMINE));
  require(MatSetType(shifted, MATAIJ));
  std::vector<PetscInt> widths;  // at most
  visit_rows(B, [&](Index, std::span<const PetscInt> columns, std::span<const double>) {
    widths.insert(widths.end(), static_cast<std::size_t>(parts), static_cast<PetscInt>(columns.size()) + 2);
  });
  require(MatXAIJSetPreallocation(shifted, 1, widths.data(), widths.data(), nullptr, nullptr));
  const auto set = [&](PetscInt row, PetscInt column, double value) {
    require(MatSetValues(shifted, 1, &row, 1, &column, &value, ADD_VALUES));
  };
  visit_rows(B, [&](Index index, std::span<const PetscInt> columns, std::span<const double> values) {
    for (PetscInt part = 0; part < parts; ++part) {
      const PetscInt row = static_cast<PetscInt>(index) * parts + part;
      for (std::size_t k = 0; k < columns.size(); ++k) set(row, columns[k] * parts + part, h * values[k]);
      set(row, row, -p.real());
      if (parts == 2) set(row, row + (part == 0 ? 1 : -1), part == 0 ? p.imag() : -p.imag());
    }
  });
  require(MatAssemblyBegin(shifted, MAT_FINAL_ASSEMBLY));
  require(MatAssemblyEnd(shifted, MAT_FINAL_ASSEMBLY));
}

bool is_direct(KSP ksp) {
  PC pc = nullptr;
  require(KSPGetPC(ksp, &pc));
  return is_of_type(ksp, KSPPREONLY) &&
         (is_of_type(pc, PCLU) || is_of_type(pc, PCCHOLESKY) || is_of_type(pc, PCREDUNDANT));
}

void make_solver(MPI_Comm communicator, const std::string& prefix, KspResolvents::Tolerance tolerance, OwnedKsp& ksp) {
  require(KSPCreate(communicator, ksp.make()));
  require(KSPSetOptionsPrefix(ksp, prefix.c_str()));
  require(KSPSetType(ksp, KSPPREONLY));
  PC pc = nullptr;
  require(KSPGetPC(ksp, &pc));
  require(PCSetType(pc, PCLU));
  int processes = 1;
  MPI_Comm_size(communicator, &processes);
  if (processes > 1) require(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  require(KSPSetFromOptions(ksp));
  if (is_direct(ksp)) return;
  if (is_of_type(static_cast<KSP>(ksp), KSPPREONLY)) {
    PetscBool is_chosen = PETSC_FALSE;
    require(PetscOptionsHasName(nullptr, prefix.c_str(), "-ksp_type", &is_chosen));
    if (is_chosen)
      throw Error(
          "-{0}ksp_type preonly with a preconditioner that is no factorisation solves nothing: leave it out, or write "
          "-{0}pc_type lu",
          prefix);
    require(KSPSetType(ksp, KSPGMRES));
    require(KSPSetFromOptions(ksp));
  }
  if (tolerance == KspResolvents::Tolerance::round_off)
    require(KSPSetTolerances(ksp, 1e-14, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
}

class KspResolvent final : public Resolvent {
 public:
  KspResolvent(Mat B, double h, std::complex<double> p, std::string prefix, KspResolvents::Tolerance tolerance,
               std::int64_t& iterations)
      : p_(p), prefix_(std::move(prefix)), iterations_(iterations) {
    const MPI_Comm communicator = communicator_of(B);
    make_shifted(B, h, p, shifted_);
    make_solver(communicator, prefix_, tolerance, ksp_);
    require(KSPSetOperators(ksp_, shifted_, shifted_));
    require(KSPSetUp(ksp_));
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
        "the linear solver of the options -{}ksp_… stopped after {} iterations with a residual of {:.3g} ({}); without them "
        "the solver is a factorisation",
        prefix_, iterations, residual, KSPConvergedReasons[reason]);
  }

  std::complex<double> p_;
  std::string prefix_;
  std::int64_t& iterations_;
  OwnedMat shifted_;
  OwnedKsp ksp_;
  BorrowedVec right_, solution_;
  mutable Vector pairs_, solved_;
};

}  // namespace

std::unique_ptr<Resolvent> KspResolvents::make(double h, std::complex<double> pole) const {
  return std::make_unique<KspResolvent>(B_, h, pole, prefix_, tolerance_, iterations_);
}

bool KspResolvents::iterates() const {
  OwnedKsp ksp;
  make_solver(communicator_of(B_), prefix_, tolerance_, ksp);
  return !is_direct(ksp);
}

}  // namespace seiche
