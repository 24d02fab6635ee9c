#include <seiche/core/base/error.hpp>
#include <seiche/petsc/ts_equation.hpp>
#include <seiche/potential/own_potential.hpp>
#include <seiche/problem/common/second_order.hpp>
#include <seiche/problem/sparse.hpp>

#include <petsctao.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace seiche {
namespace {

using OwnedVec = PetscHandle<Vec, VecDestroy>;
using OwnedMat = PetscHandle<Mat, MatDestroy>;

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

Index size_of(Vec u) {
  PetscInt size = 0;
  require(VecGetLocalSize(u, &size));
  return size;
}

// The entries of a matrix of any type that MatConvert knows, in the order of z.
SparseMatrix sparse_matrix(Mat matrix, const std::vector<Index>& order, const char* name) {
  const auto n = static_cast<Index>(order.size());
  PetscInt rows = 0, columns = 0;
  require(MatGetSize(matrix, &rows, &columns));
  if (rows != n || columns != n) throw Error("{} is {} × {}, and u has {} components", name, rows, columns, n);
  std::vector<Index> place(order.size());  // of a component of u in z
  for (Index i = 0; i < n; ++i) place[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])] = i;
  OwnedMat copy;
  require(MatConvert(matrix, MATAIJ, MAT_INITIAL_MATRIX, copy.make()));
  std::vector<Entry> entries;
  for (PetscInt row = 0; row < rows; ++row) {
    PetscInt count = 0;
    const PetscInt* at = nullptr;
    const PetscScalar* values = nullptr;
    require(MatGetRow(copy, row, &count, &at, &values));
    for (PetscInt k = 0; k < count; ++k)
      entries.push_back({place[static_cast<std::size_t>(row)], place[static_cast<std::size_t>(at[k])], values[k]});
    require(MatRestoreRow(copy, row, &count, &at, &values));
  }
  return assembled(n, entries);
}

void copy_values(Vec u, Vector& values) {
  const PetscScalar* from = nullptr;
  require(VecGetArrayRead(u, &from));
  values = Eigen::Map<const Vector>(from, values.size());
  require(VecRestoreArrayRead(u, &from));
}

}  // namespace

// V and ∇V by functions of the user's, in the order of z.
class TsEquation::Functions {
 public:
  Functions(TS ts, const TsFormulation& formulation, Vec u)
      : ts_(ts),
        formulation_(formulation),
        M_(composed<Mat>(ts, "M", MAT_CLASSID, "Mat")),
        V_(composed<Tao>(ts, "V", TAO_CLASSID, "Tao")) {
    if (M_ == nullptr)
      throw Error(
          "the quadratic part of F is not known: compose M of F(u) = ½uᵀMu + V(u) with the TS, by "
          "PetscObjectCompose((PetscObject)ts, \"M\", (PetscObject)M), or ts.compose(\"M\", M) of petsc4py");
    if (V_ == nullptr && (formulation.F == nullptr) != (formulation.gradient == nullptr))
      throw Error("TSDiscGradSetFormulation was given one of F and its gradient, and both are needed");
    require(VecDuplicate(u, u_.make()));
    require(VecDuplicate(u, slope_.make()));
    require(VecDuplicate(u, Mu_.make()));
  }

  bool is_zero() const { return V_ == nullptr && formulation_.F == nullptr; }
  Mat M() const { return M_; }
  void use(const std::vector<Index>& order) { order_ = order; }

  // The components of z from `first` on; others stay what they were.
  void set(std::span<const double> z, std::size_t first = 0) const {
    PetscScalar* u = nullptr;
    require(VecGetArray(u_, &u));
    for (std::size_t i = 0; i < z.size(); ++i) u[order_[first + i]] = z[i];
    require(VecRestoreArray(u_, &u));
  }

  double value(std::span<const double> z) const {
    set(z);
    PetscReal V = 0;
    if (V_ != nullptr) {
      require(TaoComputeObjective(V_, u_, &V));
      return V;
    }
    require(formulation_.F(ts_, time(), u_, &V, formulation_.context));
    PetscScalar uMu = 0;
    require(MatMult(M_, u_, Mu_));
    require(VecDot(u_, Mu_, &uMu));
    return V - uMu / 2;
  }

  // `out`: the components of the support. Throws SupportGrew where another one is not zero.
  void gradient(std::span<const double> z, std::span<double> out) const {
    set(z);
    if (V_ != nullptr) {
      require(TaoComputeGradient(V_, u_, slope_));
    } else {
      require(formulation_.gradient(ts_, time(), u_, slope_, formulation_.context));
      require(MatMult(M_, u_, Mu_));
      require(VecAXPY(slope_, -1, Mu_));
    }
    const PetscScalar* slope = nullptr;
    require(VecGetArrayRead(slope_, &slope));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = slope[order_[i]];
    const bool grew =
        std::any_of(order_.begin() + std::ssize(out), order_.end(), [&](Index i) { return slope[i] != 0; });
    require(VecRestoreArrayRead(slope_, &slope));
    if (grew) throw SupportGrew();
  }

  // Sets S at this u.
  void structure(Mat S) const {
    require(formulation_.S(ts_, time(), u_, S, formulation_.context));
    require(MatAssemblyBegin(S, MAT_FINAL_ASSEMBLY));
    require(MatAssemblyEnd(S, MAT_FINAL_ASSEMBLY));
  }

 private:
  PetscReal time() const {
    PetscReal t = 0;
    require(TSGetTime(ts_, &t));
    return t;
  }

  TS ts_;
  TsFormulation formulation_;
  Mat M_;
  Tao V_;
  OwnedVec u_, slope_, Mu_;
  std::vector<Index> order_;
};

namespace {

// States near the start, at random and the same in every run.
class Probes {
 public:
  explicit Probes(Vector start) : start_(std::move(start)), scale_(std::max(start_.lpNorm<Eigen::Infinity>(), 1e-3)) {}

  const Vector& next() {
    at_ = start_;
    for (double& x : at_)
      x += 0.1 * scale_ * (2 * static_cast<double>(random_()) / static_cast<double>(random_.max()) - 1);
    return at_;
  }

 private:
  Vector start_, at_;
  double scale_;
  std::mt19937_64 random_{1};
};

std::span<const double> span(const Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }
std::span<double> span(Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

}  // namespace

TsEquation::TsEquation(TS ts, const TsFormulation& formulation, Vec u, bool is_separable)
    : functions_(std::make_shared<Functions>(ts, formulation, u)) {
  Vector start(size_of(u));
  copy_values(u, start);
  order_.resize(static_cast<std::size_t>(start.size()));
  std::iota(order_.begin(), order_.end(), Index{0});
  functions_->use(order_);
  const bool in_two_fields = is_separable && find_positions(start);
  SparseSystem system{.fields = in_two_fields ? 2 : 1, .matrices = {}};
  system.matrices.M = sparse_matrix(functions_->M(), order_, "M");
  system.matrices.S = structure(ts, formulation, start);
  if (Mat D = composed<Mat>(ts, "D", MAT_CLASSID, "Mat")) system.matrices.D = sparse_matrix(D, order_, "D");
  problem_ = sparse_problem(std::move(system));
  problem_.name = "the equation of the TS";
  to_state(u, problem_.initial);
  if (functions_->is_zero()) return;
  problem_.potential = own_potential(
      {.value = [of = functions_](std::span<const double> z) { return of->value(z); },
       .gradient = [of = functions_](std::span<const double> z, std::span<double> out) { of->gradient(z, out); },
       .fields = problem_.field_count() / (in_two_fields ? 2 : 1)});
}

// True, and the components that V depends on come first, where they are half of all.
bool TsEquation::find_positions(const Vector& start) {
  if (functions_->is_zero() || start.size() % 2 != 0) return false;
  constexpr int states = 3;
  std::vector<bool> is_position(order_.size(), false);
  Probes probes(start);
  Vector slope(start.size());
  for (int k = 0; k < states; ++k) {
    functions_->gradient(span(probes.next()), span(slope));
    for (std::size_t i = 0; i < order_.size(); ++i)
      is_position[i] = is_position[i] || slope[static_cast<Index>(i)] != 0;
  }
  if (2 * std::count(is_position.begin(), is_position.end(), true) != start.size()) return false;
  std::stable_partition(order_.begin(), order_.end(),
                        [&](Index i) { return is_position[static_cast<std::size_t>(i)]; });
  functions_->use(order_);
  return true;
}

SparseMatrix TsEquation::structure(TS ts, const TsFormulation& formulation, const Vector& start) {
  if (Mat S = composed<Mat>(ts, "S", MAT_CLASSID, "Mat")) return sparse_matrix(S, order_, "S");
  if (formulation.S == nullptr)
    throw Error(
        "the structure matrix S of u̇ = S∇F(u) − Du is not known: call TSDiscGradSetFormulation once the type of the TS is "
        "set (TSSetType, TSSetFromOptions), or compose a matrix with it: PetscObjectCompose((PetscObject)ts, \"S\", "
        "(PetscObject)S), ts.compose(\"S\", S) of petsc4py");
  Probes probes(start);
  const auto at = [&](const Vector& u) {
    functions_->set(span(u));
    OwnedMat S;
    require(MatCreate(PetscObjectComm(reinterpret_cast<PetscObject>(ts)), S.make()));
    const auto n = static_cast<PetscInt>(u.size());
    require(MatSetSizes(S, n, n, n, n));
    require(MatSetUp(S));
    functions_->structure(S);
    return sparse_matrix(S, order_, "S");
  };
  Vector in_order(start.size());
  const auto ordered = [&](const Vector& u) -> const Vector& {
    for (Index i = 0; i < u.size(); ++i) in_order[i] = u[order_[static_cast<std::size_t>(i)]];
    return in_order;
  };
  SparseMatrix S = at(ordered(start));
  if (SparseMatrix(S - at(ordered(probes.next()))).norm() != 0)
    throw Error("S changes with u, and these methods take one that is the same everywhere; keep -ts_type discgrad");
  return S;
}

void TsEquation::hold_momenta(const Vector& z) {
  const auto first = static_cast<std::size_t>(problem_.field_count() == 2 ? problem_.grid.unknowns() : z.size());
  functions_->set(span(z).subspan(first), first);
}

void TsEquation::to_state(Vec u, Vector& z) const {
  const PetscScalar* from = nullptr;
  z.resize(std::ssize(order_));
  require(VecGetArrayRead(u, &from));
  for (Index i = 0; i < z.size(); ++i) z[i] = from[order_[static_cast<std::size_t>(i)]];
  require(VecRestoreArrayRead(u, &from));
}

void TsEquation::to_solution(const Vector& z, Vec u) const {
  PetscScalar* to = nullptr;
  require(VecGetArray(u, &to));
  for (Index i = 0; i < z.size(); ++i) to[order_[static_cast<std::size_t>(i)]] = z[i];
  require(VecRestoreArray(u, &to));
}

}  // namespace seiche
