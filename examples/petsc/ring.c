/* A Klein–Gordon ring with friction, stated as PETSc states Hamiltonian systems: u̇ = S∇F(u).

     ring -ts_type discgrad                            what PETSc has
     ring -dll_append $SEICHE_TS -ts_type seisav  -ts_seiche_monitor -ts_view
     ring -dll_append $SEICHE_TS -ts_type egc4 -ts_adapt_type basic -ts_rtol 1e-8 -ts_atol 1e-8
     mpiexec -n 4 ring -dll_append $SEICHE_TS -ts_type egc4 -n 4096

   with SEICHE_TS=$(pkg-config --variable=module seiche-ts), or build/release/libseiche_ts.so.

   H = Σ Δx (v²/2 + (∂u)²/2 + u²/2 + u⁴/4), ü = ∂²u − u − u³ − γu̇, u and v = u̇ side by side at each of n points. */
#include <petscts.h>

typedef struct {
  PetscInt  n, first, last; /* points, and those that are here */
  PetscReal length, gamma;
  Mat       M; /* H = Δx(½uᵀMu + Σ u⁴/4) */
} Ring;

static PetscErrorCode Structure(TS ts, PetscReal t, Vec u, Mat S, void *ctx)
{
  Ring *ring = (Ring *)ctx;

  PetscFunctionBeginUser;
  for (PetscInt i = ring->first; i < ring->last; ++i) {
    const PetscInt    row[2]    = {2 * i, 2 * i + 1};
    const PetscScalar values[4] = {0, 1, -1, -ring->gamma};
    PetscCall(MatSetValues(S, 2, row, 2, row, values, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(S, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(S, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

static PetscErrorCode Energy(TS ts, PetscReal t, Vec u, PetscScalar *F, void *ctx)
{
  Ring              *ring = (Ring *)ctx;
  const PetscScalar *x;
  PetscScalar        V = 0, quadratic;
  Vec                Mu;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(u, &x));
  for (PetscInt i = 0; i < ring->last - ring->first; ++i) V += PetscPowScalarInt(x[2 * i], 4) / 4;
  PetscCall(VecRestoreArrayRead(u, &x));
  PetscCall(VecDuplicate(u, &Mu));
  PetscCall(MatMult(ring->M, u, Mu));
  PetscCall(VecDot(u, Mu, &quadratic));
  PetscCall(VecDestroy(&Mu));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &V, 1, MPIU_SCALAR, MPIU_SUM, PETSC_COMM_WORLD));
  *F = quadratic / 2 + V;
  PetscFunctionReturn(0);
}

static PetscErrorCode Gradient(TS ts, PetscReal t, Vec u, Vec G, void *ctx)
{
  Ring              *ring = (Ring *)ctx;
  const PetscScalar *x;
  PetscScalar       *g;

  PetscFunctionBeginUser;
  PetscCall(MatMult(ring->M, u, G));
  PetscCall(VecGetArrayRead(u, &x));
  PetscCall(VecGetArray(G, &g));
  for (PetscInt i = 0; i < ring->last - ring->first; ++i) g[2 * i] += PetscPowScalarInt(x[2 * i], 3);
  PetscCall(VecRestoreArray(G, &g));
  PetscCall(VecRestoreArrayRead(u, &x));
  PetscFunctionReturn(0);
}

/* diag(1 − ∂², 1) with second differences. */
static PetscErrorCode Quadratic(Ring *ring)
{
  const PetscReal w     = PetscSqr(ring->n / ring->length);
  const PetscInt  local = 2 * (ring->last - ring->first);

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, local, local, 2 * ring->n, 2 * ring->n, 3, NULL, 2, NULL, &ring->M));
  for (PetscInt i = ring->first; i < ring->last; ++i) {
    const PetscInt row = 2 * i, momentum = 2 * i + 1;
    const PetscInt    column[3] = {row, 2 * ((i + 1) % ring->n), 2 * ((i + ring->n - 1) % ring->n)};
    const PetscScalar values[3] = {1 + 2 * w, -w, -w}, one = 1;
    PetscCall(MatSetValues(ring->M, 1, &row, 3, column, values, INSERT_VALUES));
    PetscCall(MatSetValues(ring->M, 1, &momentum, 1, &momentum, &one, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(ring->M, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(ring->M, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Ring         ring = {128, 0, 0, 20, 0.1, NULL};
  TS           ts;
  Vec          u;
  PetscScalar *x, F0, F1;
  PetscReal    t, length;
  PetscInt     steps, local;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-n", &ring.n, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-gamma", &ring.gamma, NULL));
  local = PETSC_DECIDE;
  PetscCall(PetscSplitOwnership(PETSC_COMM_WORLD, &local, &ring.n));
  PetscCallMPI(MPI_Scan(&local, &ring.last, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
  ring.first = ring.last - local;
  PetscCall(Quadratic(&ring));
  PetscCall(MatCreateVecs(ring.M, &u, NULL));
  PetscCall(VecGetArray(u, &x));
  for (PetscInt i = 0; i < local; ++i) {
    const PetscReal at = ring.length * (ring.first + i + 0.5) / ring.n - ring.length / 2;
    x[2 * i]     = PetscExpReal(-at * at);
    x[2 * i + 1] = 0;
  }
  PetscCall(VecRestoreArray(u, &x));

  PetscCall(TSCreate(PETSC_COMM_WORLD, &ts));
  PetscCall(TSSetSolution(ts, u));
  PetscCall(TSSetTimeStep(ts, 0.05));
  PetscCall(TSSetMaxTime(ts, 20));
  PetscCall(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
  PetscCall(PetscObjectCompose((PetscObject)ts, "M", (PetscObject)ring.M));
  PetscCall(TSSetFromOptions(ts));
  PetscCall(TSDiscGradSetFormulation(ts, Structure, Energy, Gradient, &ring)); /* once the type is set */

  PetscCall(Energy(ts, 0, u, &F0, &ring));
  PetscCall(TSSolve(ts, u));
  PetscCall(Energy(ts, 0, u, &F1, &ring));
  PetscCall(VecNorm(u, NORM_2, &length));
  PetscCall(TSGetSolveTime(ts, &t));
  PetscCall(TSGetStepNumber(ts, &steps));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "t = %g after %" PetscInt_FMT " steps, H/dx from %.12g to %.12g, |u| = %.12g\n", (double)t, steps, (double)F0,
                        (double)F1, (double)length));

  PetscCall(TSDestroy(&ts));
  PetscCall(VecDestroy(&u));
  PetscCall(MatDestroy(&ring.M));
  PetscCall(PetscFinalize());
  return 0;
}
