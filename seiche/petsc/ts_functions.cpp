#include <seiche/core/base/error.hpp>
#include <seiche/petsc/ts_functions.hpp>

#include <algorithm>
#include <numeric>

namespace seiche {
namespace {

MPI_Comm communicator(TS ts) { return PetscObjectComm(reinterpret_cast<PetscObject>(ts)); }

}  // namespace

template <class Object>
Object composed(TS ts, const char* name, PetscClassId kind, const char* what) {
  PetscObject object = nullptr;
  require(PetscObjectQuery(reinterpret_cast<PetscObject>(ts), name, &object));
  if (object == nullptr) return nullptr;
  PetscClassId found = 0;
  require(PetscObjectGetClassId(object, &found));
  if (found != kind) throw Error("the object \"{}\" that is composed with the TS is not a {}", name, what);
  return reinterpret_cast<Object>(object);
}
template Mat composed<Mat>(TS, const char*, PetscClassId, const char*);

TsFunctions::TsFunctions(TS ts, const TsFormulation& formulation, Mat M, Vec u) : ts_(ts), formulation_(formulation) {
  M_.share(M);
  V_.share(composed<Tao>(ts, "V", TAO_CLASSID, "Tao"));
  if (!has_V_by_tao() && (formulation.F == nullptr) != (formulation.gradient == nullptr))
    throw Error("TSDiscGradSetFormulation was given one of F and its gradient, and both are needed");
  int processes = 1;
  MPI_Comm_size(communicator(ts), &processes);
  is_alone_ = processes == 1;
  for (OwnedVec* v : {&u_, &slope_, &Mu_}) require(VecDuplicate(u, v->make()));
  PetscInt size = 0;
  require(VecGetLocalSize(u, &size));
  order_.resize(static_cast<std::size_t>(size));
  std::iota(order_.begin(), order_.end(), Index{0});
  support_ = size;
}

void TsFunctions::use(std::vector<Index> order, Index support) {
  order_ = std::move(order);
  support_ = support;
}

void TsFunctions::set(std::span<const double> z, Index first) const {
  PetscScalar* u = nullptr;
  require(VecGetArray(u_, &u));
  for (std::size_t i = 0; i < z.size(); ++i) u[order_[static_cast<std::size_t>(first) + i]] = z[i];
  require(VecRestoreArray(u_, &u));
}

double TsFunctions::value(std::span<const double> support) const {
  set(support);
  PetscReal V = 0;
  if (has_V_by_tao()) {
    require(TaoComputeObjective(V_, u_, &V));
    return V;
  }
  require(formulation_.F(ts_, time(), u_, &V, formulation_.context));
  PetscScalar uMu = 0;
  require(MatMult(M_, u_, Mu_));
  require(VecDot(u_, Mu_, &uMu));
  return V - uMu / 2;
}

void TsFunctions::gradient(std::span<const double> support, std::span<double> out) const {
  set(support);
  if (has_V_by_tao()) {
    require(TaoComputeGradient(V_, u_, slope_));
  } else {
    require(formulation_.gradient(ts_, time(), u_, slope_, formulation_.context));
    require(MatMult(M_, u_, Mu_));
    require(VecAXPY(slope_, -1, Mu_));
  }
  const PetscScalar* slope = nullptr;
  require(VecGetArrayRead(slope_, &slope));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = slope[order_[i]];
  int grew = std::any_of(order_.begin() + support_, order_.end(), [&](Index i) { return slope[i] != 0; }) ? 1 : 0;
  require(VecRestoreArrayRead(slope_, &slope));
  if (!is_alone_) MPI_Allreduce(MPI_IN_PLACE, &grew, 1, MPI_INT, MPI_MAX, communicator(ts_));
  if (grew != 0) throw SupportGrew();
}

void TsFunctions::make_structure(OwnedMat& S) const {
  const auto n = static_cast<PetscInt>(order_.size());
  require(MatCreate(communicator(ts_), S.make()));
  require(MatSetSizes(S, n, n, PETSC_DETERMINE, PETSC_DETERMINE));
  require(MatSetUp(S));
  require(MatSetOption(S, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  require(formulation_.S(ts_, time(), u_, S, formulation_.context));
  require(MatAssemblyBegin(S, MAT_FINAL_ASSEMBLY));
  require(MatAssemblyEnd(S, MAT_FINAL_ASSEMBLY));
}

PetscReal TsFunctions::time() const {
  PetscReal t = 0;
  require(TSGetTime(ts_, &t));
  return t;
}

}  // namespace seiche
