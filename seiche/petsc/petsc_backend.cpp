#include <seiche/backend/fft/transform.hpp>
#include <seiche/backend/grid/beyond_linear.hpp>
#include <seiche/backend/grid/grid_damping.hpp>
#include <seiche/backend/grid/grid_potential.hpp>
#include <seiche/backend/grid/grid_space.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/petsc/divided_points.hpp>
#include <seiche/petsc/petsc_backend.hpp>
#include <seiche/petsc/petsc_damping.hpp>
#include <seiche/petsc/petsc_system.hpp>
#include <seiche/version.hpp>

#include <petscsys.h>

#include <cstdlib>
#include <thread>

namespace seiche {
namespace {

PetscErrorCode remember(MPI_Comm, int, const char*, const char*, PetscErrorCode code, PetscErrorType type,
                        const char* message, void*) {
  if (type == PETSC_ERROR_INITIAL && message != nullptr) message_of_petsc() = message;
  return code;
}

// PETSc for as long as the program runs, with the options of the environment (PETSC_OPTIONS). What it has to say of
// errors becomes theirs; signals stay the program's.
void begin_petsc() {
  PetscBool has_begun = PETSC_FALSE;
  PetscInitialized(&has_begun);
  if (has_begun) return;
  int is_ours = 0;
  MPI_Initialized(&is_ours);
  is_ours = is_ours == 0 ? 1 : 0;
  require(PetscOptionsSetValue(nullptr, "-no_signal_handler", "1"));
  require(PetscInitializeNoArguments());
  require(PetscPushErrorHandler(remember, nullptr));
  message_of_petsc() = "it says nothing";  // from here on errors are of ours
  if (is_ours != 0) std::atexit([] { PetscFinalize(); });
}

// This process alone.
class OneRank final : public Ranks {
 public:
  Rank here() const override { return {}; }
  void gather(std::span<const double> mine, std::span<const Index>, std::span<double> all) const override {
    std::copy(mine.begin(), mine.end(), all.begin());
  }
  void exchange(std::span<const double>, std::span<const Index>, std::span<double>,
                std::span<const Index>) const override {}
};
const OneRank one_rank;

// The problem, whose rates and forces are those of the points that are here.
Problem with_rates_here(const Problem& problem, const FieldPart& part) {
  Problem known = problem;
  if (problem.damping.field_rate) known.damping.mean_field_rate = mean_field_rate(problem);
  return with_rates_at_points(known, part.first, part.of);
}

SparseMatrix matrix_of(const Problem& problem, const BlockStencil& stencil) {
  try {
    return stencil.sparse_matrix(problem.grid);
  } catch (const Error& error) {
    throw Error("the backend petsc does not take {}: {}; use discretisation \"fd2\" or \"fd4\", or backend \"modal\"",
                problem.name, error.what());
  }
}

// PETSc knows nothing of threads.
void require_one_thread() {
  static const std::thread::id first = std::this_thread::get_id();
  if (std::this_thread::get_id() != first)
    throw Error(
        "PETSc is for one thread of a program, and here several ask for it; use the backend \"sparse\" where members or runs "
        "are computed side by side");
}

System make_system(const Problem& problem, const BackendOptions& options) {
  options.sparse.validate();
  require_one_thread();
  begin_petsc();
  const Ranks& ranks = options.ranks != nullptr ? *options.ranks : one_rank;
  const MPI_Comm communicator = options.ranks != nullptr ? PETSC_COMM_WORLD : PETSC_COMM_SELF;
  int processes = 1;
  MPI_Comm_size(communicator, &processes);
  if (processes != ranks.here().count)
    throw Error("the backend petsc runs on all processes of MPI, {} of them, and {} are to hold the problem", processes,
                ranks.here().count);

  const DividedPoints divided(problem.field_count(), problem.grid.unknowns(), ranks.here());
  const std::shared_ptr<const FieldTransform> identity = identity_transform(divided.part());
  auto space = std::make_unique<GridSpace>(problem.field_count(), identity, options.ranks);
  auto potential = std::make_unique<GridPotential>(divided_potential(problem.potential, divided.part(), ranks),
                                                   problem.potential_field, identity, *space);

  struct Matrices {
    OwnedMat S, M, D, D0;
  };
  const auto held = std::make_shared<Matrices>();
  auto& [S, M, D, D0] = *held;
  const auto* given = problem.matrices.get();
  divided.make(given != nullptr ? given->S : matrix_of(problem, problem.S), communicator, S);
  divided.make(given != nullptr ? given->M : matrix_of(problem, problem.M), communicator, M);
  const SparseMatrix constant = given != nullptr ? given->D : matrix_of(problem, problem.damping.constant);
  if (constant.nonZeros() > 0) divided.make(constant, communicator, D);
  const SparseMatrix frozen =
      given != nullptr ? constant_damping_matrix(problem) : matrix_of(problem, constant_damping(problem));
  if (frozen.nonZeros() > 0) divided.make(frozen, communicator, D0);

  const Potential::Support support = potential->support();
  const SolverOptions solver =
      options.sparse.solver.empty() ? SolverOptions() : SolverOptions::of_text(options.sparse.solver);
  const PetscEquation equation{.S = S, .M = M, .D = D0, .ranks = &ranks, .solver = solver};
  System system = petsc_system(equation, std::move(space), support, options.sparse);
  system.fields = problem.field_count();
  system.potential = std::move(potential);
  std::unique_ptr<LinearMap> map;
  GridDamping::MakeFlow make_flow;
  if (constant.nonZeros() > 0) {
    map = petsc_map(D);
    make_flow = petsc_damping_flow(D, *system.space, solver);
  }
  const Problem here = ranks.here().count > 1 ? with_rates_here(problem, divided.part()) : problem;
  system.damping = std::make_unique<GridDamping>(here, identity, std::move(map), std::move(make_flow));
  add_beyond_linear(system, here, identity, [&](const Stencil& along_axis) {
    OwnedMat derivative;
    DividedPoints(1, problem.grid.unknowns(), ranks.here())
        .make(along_axis.sparse_matrix(problem.grid), communicator, derivative);
    return petsc_map(derivative);
  });
  for (auto* make : {&system.make_phi, &system.make_undamped_phi})  // which look at the matrices when they are called
    *make = [held, make_of_matrices = std::move(*make)] { return make_of_matrices(); };
  system.initial = problem.initial.size() == problem.size() ? divided.here(problem.initial) : problem.initial;
  return system;
}

}  // namespace
}  // namespace seiche

seiche::System* seiche_petsc_system(const seiche::Problem& problem, const seiche::BackendOptions& options) {
  return std::make_unique<seiche::System>(seiche::make_system(problem, options)).release();
}
const char* seiche_petsc_version() { return seiche::version_commit.data(); }
