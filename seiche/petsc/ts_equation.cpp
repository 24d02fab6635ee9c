#include <seiche/core/base/error.hpp>
#include <seiche/petsc/ts_equation.hpp>
#include <seiche/potential/own_potential.hpp>
#include <seiche/problem/sparse.hpp>

#include <petsc/private/petscimpl.h>

#include <algorithm>
#include <array>
#include <random>

namespace seiche {
namespace {

// States near a start, at random and the same in every run.
class Probes {
 public:
  explicit Probes(const Vector& start) : start_(start) {}

  const Vector& next() {
    at_ = start_;
    const double scale = 0.1 * std::max(start_.size() > 0 ? start_.lpNorm<Eigen::Infinity>() : 0.0, 1e-3);
    for (double& x : at_) x += scale * (2 * static_cast<double>(random_()) / static_cast<double>(random_.max()) - 1);
    return at_;
  }

 private:
  const Vector& start_;
  Vector at_;
  std::mt19937_64 random_{1};
};

bool differ(Mat a, Mat b) {
  OwnedMat difference;
  require(MatDuplicate(a, MAT_COPY_VALUES, difference.make()));
  add(-1, b, difference);
  return !is_zero(difference);
}

}  // namespace

TsEquation::TsEquation(TS ts, const TsFormulation& formulation, Vec u, bool is_separable)
    : ts_(ts), given_(given_now()) {
  Mat M = composed<Mat>(ts, "M", MAT_CLASSID, "Mat");
  if (M == nullptr)
    throw Error(
        "the quadratic part of F is not known: compose M of F(u) = ½uᵀMu + V(u) with the TS, by "
        "PetscObjectCompose((PetscObject)ts, \"M\", (PetscObject)M), or ts.compose(\"M\", M) of petsc4py");
  functions_ = std::make_shared<TsFunctions>(ts, formulation, M, u);
  Vector start;
  to_state(u, start);
  functions_->set(span_of(start));
  const MPI_Comm communicator = PetscObjectComm(reinterpret_cast<PetscObject>(ts));
  if (is_separable && functions_->has_V()) find_positions(communicator, start);
  to_state(u, start);
  take(M, "M", start.size(), M_);
  find_structure(ts, formulation, start);
  if (Mat D = composed<Mat>(ts, "D", MAT_CLASSID, "Mat")) take(D, "D", start.size(), D_);
}

std::array<TsEquation::Given, 4> TsEquation::given_now() const {
  constexpr std::array names = {"M", "S", "D", "V"};
  std::array<Given, 4> all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    PetscObject object = nullptr;
    require(PetscObjectQuery(reinterpret_cast<PetscObject>(ts_), names[i], &object));
    if (object == nullptr) continue;
    require(PetscObjectGetId(object, &all[i].id));
    if (*names[i] != 'V') require(PetscObjectStateGet(object, &all[i].state));
  }
  return all;
}

void TsEquation::find_positions(MPI_Comm communicator, const Vector& start) {
  constexpr int states = 3;
  std::vector<Index> order(functions_->order().begin(), functions_->order().end());
  std::vector<bool> is_position(order.size(), false);
  Probes probes(start);
  Vector slope(start.size());
  for (int k = 0; k < states; ++k) {
    functions_->gradient(span_of(probes.next()), span_of(slope));
    for (std::size_t i = 0; i < order.size(); ++i) is_position[i] = is_position[i] || slope[static_cast<Index>(i)] != 0;
  }
  const auto positions = std::count(is_position.begin(), is_position.end(), true);
  std::array<double, 2> of_all = {static_cast<double>(positions), static_cast<double>(order.size())};
  MPI_Allreduce(MPI_IN_PLACE, of_all.data(), 2, MPI_DOUBLE, MPI_SUM, communicator);
  is_separable_ = 2 * of_all[0] == of_all[1];
  if (!is_separable_) return;
  std::stable_partition(order.begin(), order.end(), [&](Index i) { return is_position[static_cast<std::size_t>(i)]; });
  functions_->use(std::move(order), positions);
}

void TsEquation::find_structure(TS ts, const TsFormulation& formulation, const Vector& start) {
  if (Mat S = composed<Mat>(ts, "S", MAT_CLASSID, "Mat")) return take(S, "S", start.size(), S_);
  if (formulation.S == nullptr)
    throw Error(
        "the structure matrix S of u̇ = S∇F(u) − Du is not known: call TSDiscGradSetFormulation once the type of the TS is "
        "set (TSSetType, TSSetFromOptions), or compose a matrix with it: PetscObjectCompose((PetscObject)ts, \"S\", "
        "(PetscObject)S), ts.compose(\"S\", S) of petsc4py");
  OwnedMat here, elsewhere;
  functions_->set(span_of(start));
  functions_->make_structure(here);
  Probes probes(start);
  functions_->set(span_of(probes.next()));
  functions_->make_structure(elsewhere);
  if (differ(here, elsewhere))
    throw Error("S changes with u, and these methods take one that is the same everywhere; keep -ts_type discgrad");
  take(here, "S", start.size(), S_);
}

// As AIJ, with rows and columns in the order of z.
void TsEquation::take(Mat given, const char* name, Index rows, OwnedMat& taken) const {
  PetscInt all_rows = 0, all_columns = 0, size = 0;
  require(MatGetSize(given, &all_rows, &all_columns));
  require(VecGetSize(functions_->layout(), &size));
  if (all_rows != size || all_columns != size)
    throw Error("{} is {} × {}, and u has {} components", name, all_rows, all_columns, size);
  int fits = local_rows(given) == rows ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &fits, 1, MPI_INT, MPI_MIN, communicator_of(given));
  if (fits == 0) throw Error("the processes hold other rows of {} than of u", name);
  OwnedMat plain;
  require(MatConvert(given, MATAIJ, MAT_INITIAL_MATRIX, plain.make()));
  std::vector<PetscInt> places;
  for (const Index i : functions_->order()) places.push_back(first_row(plain) + static_cast<PetscInt>(i));
  PetscHandle<IS, ISDestroy> order;
  require(ISCreateGeneral(communicator_of(given), static_cast<PetscInt>(places.size()), places.data(),
                          PETSC_COPY_VALUES, order.make()));
  require(ISSetPermutation(order));
  require(MatPermute(plain, order, order, taken.make()));
}

void TsEquation::hold_momenta(const Vector& z) const {
  functions_->set(span_of(z).subspan(static_cast<std::size_t>(functions_->support())), functions_->support());
}

void TsEquation::to_state(Vec u, Vector& z) const {
  const PetscScalar* from = nullptr;
  const std::span<const Index> order = functions_->order();
  z.resize(std::ssize(order));
  require(VecGetArrayRead(u, &from));
  for (Index i = 0; i < z.size(); ++i) z[i] = from[order[static_cast<std::size_t>(i)]];
  require(VecRestoreArrayRead(u, &from));
}

void TsEquation::to_solution(const Vector& z, Vec u) const {
  PetscScalar* to = nullptr;
  const std::span<const Index> order = functions_->order();
  require(VecGetArray(u, &to));
  for (Index i = 0; i < z.size(); ++i) to[order[static_cast<std::size_t>(i)]] = z[i];
  require(VecRestoreArray(u, &to));
}

Problem problem_of(const TsEquation& equation, const Vector& initial) {
  SparseSystem system{.fields = equation.is_separable() ? 2 : 1, .matrices = {}};
  system.matrices.M = sparse_matrix(equation.M());
  system.matrices.S = sparse_matrix(equation.S());
  if (equation.D() != nullptr) system.matrices.D = sparse_matrix(equation.D());
  Problem problem = sparse_problem(std::move(system));
  problem.name = "the equation of the TS";
  problem.initial = initial;
  const std::shared_ptr<TsFunctions>& of = equation.functions();
  if (!of->has_V()) return problem;
  problem.potential =
      own_potential({.value = [of](std::span<const double> q) { return of->value(q); },
                     .gradient = [of](std::span<const double> q, std::span<double> out) { of->gradient(q, out); }});
  return problem;
}

}  // namespace seiche
