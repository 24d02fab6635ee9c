/* Time against error of PETSc's own steppers and of Seiche's, on equations that have an energy law.

     petsc_peers -dll_append build/bench/libseiche_ts.so [-problem klein_gordon|alpha_fpu|alpha_fpu_in_S]
       [-gamma 0.1] [-end 20] [-only arkimex] [-repeat 3]

   u̇ = S∇F(u) − Du. discgrad and arkimex have the Jacobians that suit them, by formula; arkimex takes the linear part
   implicitly. Errors are those against egc8 with a step as short as none of theirs. The set-up of a solver is not part of
   its time; its first step, in which matrices are factorised, is. */
#include <petscts.h>
#include <petsctime.h>

typedef struct {
  const char *name;
  PetscInt    n; /* points: positions first, and then momenta */
  PetscReal   end, gamma, beta, dx, strength;
  PetscBool   is_ring, damping_in_S;
  Mat         S, M, D, A; /* A = (S − D)M: D acts on momenta, of which ∇F is what they are */
  Mat         J;          /* (S − D)∇²F, or A shifted */
  Vec         work;
} Equation;

static PetscInt Next(const Equation *e, PetscInt i) { return i + 1 < e->n ? i + 1 : e->is_ring ? 0 : -1; }

/* V of a ring Σu⁴/4; of a chain that is held at its ends c Σ(u_{j+1} − u_j)³ over its bonds. */
static PetscReal Stretch(const Equation *e, const PetscScalar *u, PetscInt bond)
{
  return (bond < e->n ? u[bond] : 0) - (bond > 0 ? u[bond - 1] : 0);
}

static PetscErrorCode Potential(const Equation *e, Vec z, PetscReal *V)
{
  const PetscScalar *u;

  PetscFunctionBeginUser;
  *V = 0;
  PetscCall(VecGetArrayRead(z, &u));
  if (e->is_ring)
    for (PetscInt i = 0; i < e->n; ++i) *V += u[i] * u[i] * u[i] * u[i] / 4;
  else
    for (PetscInt b = 0; b <= e->n; ++b) *V += e->strength * Stretch(e, u, b) * Stretch(e, u, b) * Stretch(e, u, b);
  PetscCall(VecRestoreArrayRead(z, &u));
  PetscFunctionReturn(0);
}

static PetscErrorCode AddForce(const Equation *e, Vec z, PetscScalar factor, PetscInt offset, Vec out)
{
  const PetscScalar *u;
  PetscScalar       *g;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(z, &u));
  PetscCall(VecGetArray(out, &g));
  for (PetscInt i = 0; i < e->n; ++i) {
    const PetscReal left = Stretch(e, u, i), right = Stretch(e, u, i + 1);
    g[offset + i] += factor * (e->is_ring ? u[i] * u[i] * u[i] : 3 * e->strength * (left * left - right * right));
  }
  PetscCall(VecRestoreArray(out, &g));
  PetscCall(VecRestoreArrayRead(z, &u));
  PetscFunctionReturn(0);
}

static PetscErrorCode Energy(TS ts, PetscReal t, Vec z, PetscScalar *F, void *ctx)
{
  Equation   *e = (Equation *)ctx;
  PetscScalar quadratic;

  PetscFunctionBeginUser;
  PetscCall(Potential(e, z, F));
  PetscCall(MatMult(e->M, z, e->work));
  PetscCall(VecDot(z, e->work, &quadratic));
  *F += quadratic / 2;
  PetscFunctionReturn(0);
}

static PetscErrorCode Gradient(TS ts, PetscReal t, Vec z, Vec g, void *ctx)
{
  Equation *e = (Equation *)ctx;

  PetscFunctionBeginUser;
  PetscCall(MatMult(e->M, z, g));
  PetscCall(AddForce(e, z, 1, 0, g));
  PetscFunctionReturn(0);
}

static PetscErrorCode Structure(TS ts, PetscReal t, Vec z, Mat S, void *ctx)
{
  Equation *e = (Equation *)ctx;

  PetscFunctionBeginUser;
  for (PetscInt row = 0; row < 2 * e->n; ++row) {
    for (int part = 0; part < 2; ++part) { /* S − D: discgrad knows no D */
      Mat                from = part == 0 ? e->S : e->D;
      PetscInt           count;
      const PetscInt    *columns;
      const PetscScalar *values;
      PetscCall(MatGetRow(from, row, &count, &columns, &values));
      for (PetscInt k = 0; k < count; ++k)
        PetscCall(MatSetValue(S, row, columns[k], part == 0 ? values[k] : -values[k], ADD_VALUES));
      PetscCall(MatRestoreRow(from, row, &count, &columns, &values));
    }
  }
  PetscCall(MatAssemblyBegin(S, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(S, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Of the right-hand side; the friction of momenta has no part in ∇²V. */
static PetscErrorCode Jacobian(TS ts, PetscReal t, Vec z, Mat J, Mat P, void *ctx)
{
  Equation          *e = (Equation *)ctx;
  const PetscScalar *u;

  PetscFunctionBeginUser;
  PetscCall(MatCopy(e->A, P, SUBSET_NONZERO_PATTERN));
  PetscCall(VecGetArrayRead(z, &u));
  for (PetscInt i = 0; i < e->n; ++i) {
    const PetscInt row = e->n + i;
    if (e->is_ring) {
      PetscCall(MatSetValue(P, row, i, -3 * u[i] * u[i], ADD_VALUES));
      continue;
    }
    const PetscReal left = 6 * e->strength * Stretch(e, u, i), right = 6 * e->strength * Stretch(e, u, i + 1);
    PetscCall(MatSetValue(P, row, i, -(left + right), ADD_VALUES));
    if (i > 0) PetscCall(MatSetValue(P, row, i - 1, left, ADD_VALUES));
    if (i + 1 < e->n) PetscCall(MatSetValue(P, row, i + 1, right, ADD_VALUES));
  }
  PetscCall(VecRestoreArrayRead(z, &u));
  PetscCall(MatAssemblyBegin(P, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(P, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

static PetscErrorCode LinearPart(TS ts, PetscReal t, Vec z, Vec zdot, Vec out, void *ctx)
{
  PetscFunctionBeginUser;
  PetscCall(MatMult(((Equation *)ctx)->A, z, out));
  PetscCall(VecAYPX(out, -1, zdot));
  PetscFunctionReturn(0);
}

static PetscErrorCode LinearJacobian(TS ts, PetscReal t, Vec z, Vec zdot, PetscReal shift, Mat J, Mat P, void *ctx)
{
  PetscFunctionBeginUser;
  PetscCall(MatCopy(((Equation *)ctx)->A, P, SUBSET_NONZERO_PATTERN));
  PetscCall(MatScale(P, -1));
  PetscCall(MatShift(P, shift));
  PetscFunctionReturn(0);
}

static PetscErrorCode Rest(TS ts, PetscReal t, Vec z, Vec out, void *ctx)
{
  Equation *e = (Equation *)ctx;

  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(out));
  PetscCall(AddForce(e, z, -1, e->n, out));
  PetscFunctionReturn(0);
}

static PetscErrorCode RightHandSide(TS ts, PetscReal t, Vec z, Vec out, void *ctx)
{
  Equation *e = (Equation *)ctx;

  PetscFunctionBeginUser;
  PetscCall(MatMult(e->A, z, out));
  PetscCall(AddForce(e, z, -1, e->n, out));
  PetscFunctionReturn(0);
}

static PetscErrorCode Set(Equation *e)
{
  const PetscInt  N = 2 * e->n;
  const PetscReal w = 1 / (e->dx * e->dx);

  PetscFunctionBeginUser;
  for (Mat *a = &e->S; a <= &e->J; ++a) {
    PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, N, N, 8, NULL, a));
    PetscCall(MatSetOption(*a, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
    for (PetscInt i = 0; i < N; ++i) PetscCall(MatSetValue(*a, i, i, 0, ADD_VALUES));
  }
  for (PetscInt i = 0; i < e->n; ++i) {
    const PetscInt p = e->n + i, next = Next(e, i);
    PetscCall(MatSetValue(e->S, i, p, 1, ADD_VALUES));
    PetscCall(MatSetValue(e->S, p, i, -1, ADD_VALUES));
    PetscCall(MatSetValue(e->M, i, i, 1 + 2 * w, ADD_VALUES));
    PetscCall(MatSetValue(e->M, p, p, 1, ADD_VALUES));
    PetscCall(MatSetValue(e->damping_in_S ? e->S : e->D, p, p, e->damping_in_S ? -e->gamma : e->gamma, ADD_VALUES));
    PetscCall(MatSetValue(e->D, p, p, 2 * e->beta * w, ADD_VALUES));
    if (next < 0) continue;
    for (int way = 0; way < 2; ++way) {
      const PetscInt a = way == 0 ? i : next, b = way == 0 ? next : i;
      PetscCall(MatSetValue(e->M, a, b, -w, ADD_VALUES));
      if (e->beta != 0) PetscCall(MatSetValue(e->D, e->n + a, e->n + b, -e->beta * w, ADD_VALUES));
    }
  }
  for (Mat *a = &e->S; a <= &e->D; ++a) {
    PetscCall(MatAssemblyBegin(*a, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(*a, MAT_FINAL_ASSEMBLY));
  }
  PetscCall(Structure(NULL, 0, NULL, e->J, e)); /* S − D */
  PetscCall(MatDestroy(&e->A));
  PetscCall(MatMatMult(e->J, e->M, MAT_INITIAL_MATRIX, 4, &e->A));
  for (PetscInt i = 0; i < N; ++i) PetscCall(MatSetValue(e->A, i, i, 0, ADD_VALUES));
  for (PetscInt i = 0; i < e->n; ++i) PetscCall(MatSetValue(e->A, e->n + i, i, 0, ADD_VALUES));
  PetscCall(MatAssemblyBegin(e->A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(e->A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatDestroy(&e->J));
  PetscCall(MatDuplicate(e->A, MAT_COPY_VALUES, &e->J));
  PetscFunctionReturn(0);
}

static PetscReal Softplus(PetscReal x) { return x > 0 ? x + PetscLogReal(1 + PetscExpReal(-x)) : PetscLogReal(1 + PetscExpReal(x)); }

static PetscErrorCode Start(const Equation *e, Vec z)
{
  PetscScalar *u;

  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(z));
  PetscCall(VecGetArray(z, &u));
  for (PetscInt i = 0; i < e->n; ++i) {
    const PetscReal x = e->dx * ((PetscReal)i + 0.5) - e->dx * e->n / 2, j = i + 1;
    u[i] = e->is_ring ? 2 * PetscExpReal(-x * x)
                      : 5 * (Softplus(0.2 * (j - 97)) + Softplus(0.2 * (j - 32)) - Softplus(0.2 * (j - 96)) - Softplus(0.2 * (j - 33)));
  }
  PetscCall(VecRestoreArray(z, &u));
  PetscFunctionReturn(0);
}

typedef struct {
  Equation *equation;
  PetscReal before, rise; /* of H in a step */
} Law;

static PetscErrorCode Watch(TS ts, PetscInt step, PetscReal t, Vec z, void *ctx)
{
  Law        *law = (Law *)ctx;
  PetscScalar H;

  PetscFunctionBeginUser;
  PetscCall(Energy(ts, t, z, &H, law->equation));
  if (step > 0) law->rise = PetscMax(law->rise, H - law->before);
  law->before = H;
  PetscFunctionReturn(0);
}

/* One run from the start; z ← where it ends. */
static PetscErrorCode Run(Equation *e, const char *options, PetscReal dt, Law *law, Vec z, PetscReal *seconds)
{
  TS             ts;
  PetscLogDouble begin, end;
  PetscBool      is_arkimex, is_discgrad, is_rk;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsInsertString(NULL, options));
  PetscCall(Start(e, z));
  PetscCall(TSCreate(PETSC_COMM_SELF, &ts));
  PetscCall(TSSetProblemType(ts, TS_NONLINEAR));
  PetscCall(TSSetSolution(ts, z));
  PetscCall(TSSetTimeStep(ts, dt));
  PetscCall(TSSetMaxTime(ts, e->end));
  PetscCall(TSSetMaxSteps(ts, 100000000));
  PetscCall(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
  PetscCall(PetscObjectCompose((PetscObject)ts, "M", (PetscObject)e->M));
  PetscCall(PetscObjectCompose((PetscObject)ts, "S", (PetscObject)e->S));
  PetscCall(PetscObjectCompose((PetscObject)ts, "D", (PetscObject)e->D));
  PetscCall(TSSetFromOptions(ts));
  PetscCall(PetscObjectTypeCompare((PetscObject)ts, TSARKIMEX, &is_arkimex));
  PetscCall(PetscObjectTypeCompare((PetscObject)ts, TSDISCGRAD, &is_discgrad));
  PetscCall(TSDiscGradSetFormulation(ts, Structure, Energy, Gradient, e));
  if (is_discgrad) PetscCall(TSSetRHSJacobian(ts, e->J, e->J, Jacobian, e));
  PetscCall(PetscObjectTypeCompare((PetscObject)ts, TSRK, &is_rk));
  if (is_rk) PetscCall(TSSetRHSFunction(ts, NULL, RightHandSide, e));
  if (is_arkimex) {
    PetscCall(TSSetIFunction(ts, NULL, LinearPart, e));
    PetscCall(TSSetIJacobian(ts, e->J, e->J, LinearJacobian, e));
    PetscCall(TSSetRHSFunction(ts, NULL, Rest, e));
  }
  if (law) PetscCall(TSMonitorSet(ts, Watch, law, NULL));
  PetscCall(TSSetUp(ts));
  PetscCall(PetscTime(&begin));
  PetscCall(TSSolve(ts, z));
  PetscCall(PetscTime(&end));
  *seconds = end - begin;
  PetscCall(TSDestroy(&ts));
  PetscFunctionReturn(0);
}

#define NEWTON "-snes_atol 1e-11 -snes_rtol 1e-9 -snes_stol 1e-13 -ksp_type preonly -pc_type lu "
#define LINEAR "-snes_type ksponly -ksp_type preonly -pc_type lu -ts_adapt_type none -snes_lag_jacobian_persists 1 -snes_lag_preconditioner_persists 1 -snes_lag_jacobian -2 -snes_lag_preconditioner -2 "

int main(int argc, char **argv)
{
  static const struct {
    const char *name, *options;
    PetscReal   dt[4];
  } steppers[] = {
    {"discgrad (Gonzalez)", "-ts_type discgrad -ts_discgrad_gonzalez " NEWTON,                 {0.2, 0.05, 0.0125, 0.003125}   },
    {"discgrad, Jacobian kept", "-ts_type discgrad -ts_discgrad_gonzalez -snes_lag_jacobian_persists 1 -snes_lag_jacobian 20 " NEWTON, {0.2, 0.05, 0.0125, 0.003125}},
    {"arkimex 3",           "-ts_type arkimex -ts_arkimex_type 3 " LINEAR,                      {0.1, 0.025, 0.00625, 0.0015625}},
    {"arkimex 4",           "-ts_type arkimex -ts_arkimex_type 4 " LINEAR,                      {0.1, 0.025, 0.00625, 0.0015625}},
    {"arkimex 5",           "-ts_type arkimex -ts_arkimex_type 5 " LINEAR,                      {0.1, 0.025, 0.00625, 0.0015625}},
    {"rk 4",                "-ts_type rk -ts_rk_type 4 -ts_adapt_type none ",                    {0.02, 0.01, 0.005, 0.0025}     },
    {"seisav",              "-ts_type seisav ",                                                  {0.2, 0.05, 0.0125, 0.003125}   },
    {"seidm",               "-ts_type seidm ",                                                   {0.2, 0.05, 0.0125, 0.003125}   },
    {"egc4",                "-ts_type egc4 ",                                                    {0.2, 0.1, 0.05, 0.025}         },
    {"egc6",                "-ts_type egc6 ",                                                    {0.4, 0.2, 0.1, 0.05}           },
  };
  char       problem[64] = "klein_gordon", only[64] = "";
  Equation   e           = {0};
  Vec        z, exact;
  PetscReal  seconds, H0, H1;
  PetscInt   repeat = 3;
  PetscBool  is_fpu;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-problem", problem, sizeof problem, NULL));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-only", only, sizeof only, NULL));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-repeat", &repeat, NULL));
  PetscCall(PetscStrncmp(problem, "alpha_fpu", 9, &is_fpu));
  e.name    = problem;
  e.is_ring = is_fpu ? PETSC_FALSE : PETSC_TRUE;
  e.n       = is_fpu ? 127 : 128;
  e.dx      = is_fpu ? 1 : 20.0 / 128;
  e.end     = 20;
  e.gamma   = is_fpu ? 0.02 : 0.1;
  e.beta    = is_fpu ? 0.01 : 0;
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-gamma", &e.gamma, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-end", &e.end, NULL));
  PetscCall(PetscStrcmp(problem, "alpha_fpu_in_S", &e.damping_in_S));
  e.strength = 0.25 / 6; /* of ε/(6Δx³) */
  PetscCall(Set(&e));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, 2 * e.n, &z));
  PetscCall(VecDuplicate(z, &exact));
  PetscCall(VecDuplicate(z, &e.work));
  PetscCall(Run(&e, "-ts_type egc8", 0.01, NULL, exact, &seconds));
  PetscCall(Energy(NULL, 0, exact, &H1, &e));
  PetscCall(Start(&e, z));
  PetscCall(Energy(NULL, 0, z, &H0, &e));
  PetscCall(PetscPrintf(PETSC_COMM_SELF, "%s, %d unknowns, to t = %g: H from %.6g to %.6g\n%-26s %9s %10s %12s %12s %10s\n", e.name,
                        (int)(2 * e.n), (double)e.end, (double)H0, (double)H1, "stepper", "dt", "error", "energy", "rise of H", "seconds"));
  for (size_t s = 0; s < sizeof steppers / sizeof *steppers; ++s) {
    if (*only && !strstr(steppers[s].name, only)) continue;
    PetscCall(PetscOptionsClearValue(NULL, "-snes_type"));
    PetscCall(PetscOptionsClearValue(NULL, "-snes_lag_jacobian"));
    PetscCall(PetscOptionsClearValue(NULL, "-snes_lag_preconditioner"));
    PetscCall(PetscOptionsClearValue(NULL, "-snes_lag_jacobian_persists"));
    PetscCall(PetscOptionsClearValue(NULL, "-snes_lag_preconditioner_persists"));
    for (int k = 0; k < 4; ++k) {
      Law       law  = {&e, H0, 0};
      PetscReal best = PETSC_MAX_REAL, error, H;
      PetscCall(Run(&e, steppers[s].options, steppers[s].dt[k], &law, z, &seconds));
      for (PetscInt i = 0; i < repeat; ++i) {
        PetscCall(Run(&e, steppers[s].options, steppers[s].dt[k], NULL, z, &seconds));
        best = PetscMin(best, seconds);
      }
      PetscCall(Energy(NULL, 0, z, &H, &e));
      PetscCall(VecAXPY(z, -1, exact));
      PetscCall(VecNorm(z, NORM_INFINITY, &error));
      PetscCall(PetscPrintf(PETSC_COMM_SELF, "%-26s %9g %10.2e %12.2e %12.2e %10.4f\n", steppers[s].name, (double)steppers[s].dt[k],
                            (double)error, (double)(PetscAbsReal(H - H1) / H0), (double)(law.rise / H0), (double)best));
    }
  }
  for (Mat *a = &e.S; a <= &e.J; ++a) PetscCall(MatDestroy(a));
  PetscCall(VecDestroy(&z));
  PetscCall(VecDestroy(&exact));
  PetscCall(VecDestroy(&e.work));
  PetscCall(PetscFinalize());
  return 0;
}
