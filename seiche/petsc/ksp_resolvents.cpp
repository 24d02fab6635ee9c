#include <seiche/core/base/error.hpp>
#include <seiche/petsc/ksp_resolvents.hpp>

namespace seiche {
namespace {

using OwnedKsp = PetscHandle<KSP, KSPDestroy>;

// hB − p, or the real system of twice the size: the two parts of each unknown side by side.
void make_shifted(Mat B, double h, std::complex<double> p, OwnedMat& shifted) {
  const PetscInt parts = p.imag() == 0 ? 1 : 2;
  const auto rows = static_cast<PetscInt>(local_rows(B)) * parts;
  require(MatCreate(communicator_of(B), shifted.make()));
  require(MatSetSizes(shifted, rows, rows, PETSC_DETERMINE, PETSC_DETERMINE));
  require(MatSetType(shifted, MATAIJ));
  PetscInt widest = 0;
  visit_rows(B, [&](Index, std::span<const PetscInt> columns, std::span<const double>) {
    widest = std::max(widest, static_cast<PetscInt>(columns.size()));
  });
  require(MatXAIJSetPreallocation(shifted, 1, nullptr, nullptr, nullptr, nullptr));
  require(MatSeqAIJSetPreallocation(shifted, widest + 2, nullptr));
  require(MatMPIAIJSetPreallocation(shifted, widest + 2, nullptr, widest, nullptr));
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

void make_solver(MPI_Comm communicator, OwnedKsp& ksp) {
  require(KSPCreate(communicator, ksp.make()));
  require(KSPSetOptionsPrefix(ksp, "seiche_"));
  require(KSPSetType(ksp, KSPPREONLY));
  PC pc = nullptr;
  require(KSPGetPC(ksp, &pc));
  require(PCSetType(pc, PCLU));
  int processes = 1;
  MPI_Comm_size(communicator, &processes);
  if (processes > 1) require(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  require(KSPSetFromOptions(ksp));
}

class KspResolvent final : public Resolvent {
 public:
  KspResolvent(Mat B, double h, std::complex<double> p, std::int64_t& iterations) : p_(p), iterations_(iterations) {
    const MPI_Comm communicator = communicator_of(B);
    make_shifted(B, h, p, shifted_);
    make_solver(communicator, ksp_);
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
  static std::span<const double> span(const Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

  void solve(const Vector& b, Vector& x) const {
    require(KSPSolve(ksp_, right_.of(span(b)), solution_.of(span(x))));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt iterations = 0;
    require(KSPGetConvergedReason(ksp_, &reason));
    require(KSPGetIterationNumber(ksp_, &iterations));
    iterations_ += iterations;
    if (reason > 0) return;
    PetscReal residual = 0;
    require(KSPGetResidualNorm(ksp_, &residual));
    throw Error(
        "the linear solver of the options -seiche_ksp_… stopped after {} iterations with a residual of {:.3g} ({}); without "
        "them the solver is a factorisation",
        iterations, residual, KSPConvergedReasons[reason]);
  }

  std::complex<double> p_;
  std::int64_t& iterations_;
  OwnedMat shifted_;
  OwnedKsp ksp_;
  BorrowedVec right_, solution_;
  mutable Vector pairs_, solved_;
};

}  // namespace

std::unique_ptr<Resolvent> KspResolvents::make(double h, std::complex<double> pole) const {
  return std::make_unique<KspResolvent>(B_, h, pole, iterations_);
}

bool KspResolvents::iterates() const {
  OwnedKsp ksp;
  make_solver(communicator_of(B_), ksp);
  PetscBool is_direct = PETSC_FALSE;
  require(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(static_cast<KSP>(ksp)), KSPPREONLY, &is_direct));
  return is_direct == PETSC_FALSE;
}

}  // namespace seiche
