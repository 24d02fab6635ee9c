#include <seiche/petsc/solver/presb.hpp>

#include <array>
#include <cmath>

namespace seiche {
namespace {

using OwnedSet = PetscHandle<IS, ISDestroy>;

// Solvers of blocks are one application of their preconditioner, unless options say otherwise.
void set_up_block(KSP ksp, PCType preconditioner) {
  PC pc = nullptr;
  require(KSPGetPC(ksp, &pc));
  require(PCSetType(pc, preconditioner));
  require(KSPSetType(ksp, KSPPREONLY));
  require(KSPSetFromOptions(ksp));
  require(KSPSetUp(ksp));
}

}  // namespace

Presb::Presb(Mat B, double h, std::complex<double> p, Index first, const SolverOptions& options) : b_(p.imag()) {
  make_shifted(B, h, p.real() + std::abs(b_), H_);
  require(MatScale(H_, -1));
  const MPI_Comm communicator = communicator_of(B);
  for (BorrowedVec* v : {&right_of_, &solution_}) v->set_layout(communicator, local_rows(B));
  for (Vector* v : {&right_, &sum_, &x_}) v->setZero(local_rows(B));
  require(KSPCreate(communicator, ksp_.make()));
  options.give_to(ksp_, "presb_");
  require(KSPSetType(ksp_, KSPPREONLY));
  require(KSPSetOperators(ksp_, H_, H_));
  PC pc = nullptr;
  require(KSPGetPC(ksp_, &pc));
  std::array<long long, 2> sizes = {first, local_rows(B)};  // of all processes, some of which may hold nothing
  MPI_Allreduce(MPI_IN_PLACE, sizes.data(), 2, MPI_LONG_LONG, MPI_SUM, communicator);
  const bool splits = sizes[0] > 0 && sizes[0] < sizes[1];
  if (splits) split_fields(pc, local_rows(B), first);
  require(KSPSetFromOptions(ksp_));
  require(KSPSetUp(ksp_));
  PetscBool is_split = PETSC_FALSE;
  require(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(pc), PCFIELDSPLIT, &is_split));
  if (!splits || is_split == PETSC_FALSE) return;
  PetscInt count = 0;
  KSP* blocks = nullptr;
  require(PCFieldSplitSchurGetSubKSP(pc, &count, &blocks));
  set_up_block(blocks[0], PCJACOBI);
  set_up_block(blocks[1], PCGAMG);
  require(PetscFree(blocks));
}

// The Schur complement of a block that is a multiple of the identity is sparse, and its matrix exact.
void Presb::split_fields(PC pc, Index rows, Index first) const {
  require(PCSetType(pc, PCFIELDSPLIT));
  const MPI_Comm communicator = communicator_of(H_);
  const PetscInt begin = first_row(H_);
  OwnedSet u, v;
  require(ISCreateStride(communicator, static_cast<PetscInt>(first), begin, 1, u.make()));
  require(ISCreateStride(communicator, static_cast<PetscInt>(rows - first), begin + static_cast<PetscInt>(first), 1,
                         v.make()));
  require(PCFieldSplitSetIS(pc, "u", u));
  require(PCFieldSplitSetIS(pc, "v", v));
  require(PCFieldSplitSetType(pc, PC_COMPOSITE_SCHUR));
  require(PCFieldSplitSetSchurFactType(pc, PC_FIELDSPLIT_SCHUR_FACT_FULL));
  require(PCFieldSplitSetSchurPre(pc, PC_FIELDSPLIT_SCHUR_PRE_SELFP, nullptr));
}

void Presb::attach(PC pc) {
  require(PCSetType(pc, PCSHELL));
  require(PCShellSetName(pc, "presb"));
  require(PCShellSetContext(pc, this));
  require(PCShellSetApply(pc, apply_to));
}

PetscErrorCode Presb::apply_to(PC pc, Vec r, Vec z) {
  return told_to_petsc(PetscObjectComm(reinterpret_cast<PetscObject>(pc)), "Presb::apply_to", [&] {
    Presb* self = nullptr;
    require(PCShellGetContext(pc, &self));
    self->apply(r, z);
  });
}

void Presb::apply(Vec r, Vec z) const {
  const Index n = right_.size(), parts = b_ == 0 ? 1 : 2;
  const double sign = b_ < 0 ? -1 : 1;  // of the second unknowns and equations, so that b > 0
  const PetscScalar* given = nullptr;
  PetscScalar* found = nullptr;
  require(VecGetArrayRead(r, &given));
  require(VecGetArrayWrite(z, &found));
  if (parts == 2) {
    for (Index i = 0; i < n; ++i) right_[i] = -given[2 * i] - sign * given[2 * i + 1];
    solve(right_, sum_);
  }
  for (Index i = 0; i < n; ++i) right_[i] = -given[parts * i] + std::abs(b_) * sum_[i];
  solve(right_, x_);
  for (Index i = 0; i < n; ++i) {
    found[parts * i] = x_[i];
    if (parts == 2) found[2 * i + 1] = sign * (sum_[i] - x_[i]);
  }
  require(VecRestoreArrayWrite(z, &found));
  require(VecRestoreArrayRead(r, &given));
}

void Presb::solve(const Vector& right, Vector& x) const {
  require(KSPSolve(ksp_, right_of_.of(span_of(right)), solution_.of(span_of(x))));
}

}  // namespace seiche
