#include <seiche/core/base/error.hpp>
#include <seiche/core/text/name_advice.hpp>
#include <seiche/petsc/ts_run.hpp>
#include <seiche/petsc/ts_type.hpp>

#include <petsc/private/tsimpl.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace seiche {
namespace {

// What a TS of one of these types holds.
struct TsData {
  TsFormulation formulation;
  TsOptions options;
  std::unique_ptr<TsRun> run;  // null before TSSetUp
  bool is_stale = false;       // since then there are other options
};

TsData& data_of(TS ts) { return *static_cast<TsData*>(ts->data); }

MPI_Comm communicator(TS ts) { return PetscObjectComm(reinterpret_cast<PetscObject>(ts)); }

PetscErrorCode set_formulation(TS ts, decltype(TsFormulation::S) S, decltype(TsFormulation::F) F,
                               decltype(TsFormulation::gradient) gradient, void* context) {
  data_of(ts).formulation = {S, F, gradient, context};
  data_of(ts).is_stale = true;
  return 0;
}

bool wants_variable_steps(TS ts) {
  TSAdaptType type = nullptr;
  require(TSAdaptGetType(ts->adapt, &type));
  return std::string_view(type) != TSADAPTNONE;
}

void make_run(TS ts) {
  TsData& data = data_of(ts);
  data.options.simulation.variable_steps = wants_variable_steps(ts);
  data.run.reset();
  data.run = std::make_unique<TsRun>(ts, data.formulation, data.options, ts->vec_sol);
  data.is_stale = false;
}

PetscErrorCode set_up(TS ts) {
  return told_to_petsc(communicator(ts), "TSSetUp_Seiche", [ts] { make_run(ts); });
}

// A step that the method could not take: a shorter one is to be tried, where PETSc may choose one.
void answer_failure(TS ts, const StepReport& report) {
  if (!data_of(ts).options.simulation.variable_steps) {
    if (ts->errorifstepfailed) throw Error("{}", report.message);
    ts->reason = TS_DIVERGED_NONLINEAR_SOLVE;
    return;
  }
  require(PetscInfo(ts, "%s\n", report.message.c_str()));
  ts->time_step *= ts->adapt->scale_solve_failed;
}

PetscErrorCode step(TS ts) {
  return told_to_petsc(communicator(ts), "TSStep_Seiche", [ts] {
    if (data_of(ts).is_stale || data_of(ts).run->takes_variable_steps() != wants_variable_steps(ts)) make_run(ts);
    TsRun& run = *data_of(ts).run;
    run.follow(ts->vec_sol, ts->ptime, ts->steprestart);
    for (PetscInt rejections = 0; !ts->reason;) {
      const PetscReal h = ts->time_step;
      require(TSPreStage(ts, ts->ptime + h));
      const StepReport report = run.step(h, ts->vec_sol);
      if (report.solved()) {
        require(TSPostStage(ts, ts->ptime + h, 0, &ts->vec_sol));
        PetscBool accept = PETSC_TRUE, in_domain = PETSC_TRUE;
        PetscReal next = h;
        require(TSFunctionDomainError(ts, ts->ptime + h, ts->vec_sol, &in_domain));
        if (in_domain) {
          require(TSAdaptCandidatesClear(ts->adapt));
          require(TSAdaptCandidateAdd(ts->adapt, nullptr, run.method().order, 1, 1.0, 1.0, PETSC_TRUE));
          require(TSAdaptChoose(ts->adapt, ts, h, nullptr, &next, &accept));
        } else {
          next = h * ts->adapt->scale_solve_failed;
        }
        if (accept && in_domain) {
          ts->ptime += h;
          ts->time_step = next;
          return;
        }
        run.undo(ts->vec_sol);
        ts->time_step = next;
      } else {
        answer_failure(ts, report);
      }
      ts->reject++;
      if (!ts->reason && ts->max_reject >= 0 && ++rejections > ts->max_reject) ts->reason = TS_DIVERGED_STEP_REJECTED;
    }
  });
}

PetscErrorCode roll_back(TS ts) {
  return told_to_petsc(communicator(ts), "TSRollBack_Seiche", [ts] { data_of(ts).run->undo(ts->vec_sol); });
}

PetscErrorCode interpolate(TS ts, PetscReal t, Vec u) {
  return told_to_petsc(communicator(ts), "TSInterpolate_Seiche", [=] { data_of(ts).run->interpolate(t, u); });
}

// The error of the last step relative to -ts_atol + |u| -ts_rtol, both in the max norm.
PetscErrorCode evaluate_error(TS ts, NormType, PetscInt* order, PetscReal* weighted) {
  return told_to_petsc(communicator(ts), "TSEvaluateWLTE_Seiche", [=] {
    if (ts->vatol != nullptr || ts->vrtol != nullptr)
      throw Error(
          "tolerances of every component are not taken; give one for all by TSSetTolerances(ts, atol, NULL, rtol, NULL)");
    TsRun& run = *data_of(ts).run;
    *order = run.method().order + 1;
    const std::optional<double> error = run.error();
    PetscReal largest = 0;
    require(VecNorm(ts->vec_sol, NORM_INFINITY, &largest));
    const PetscReal allowed = ts->atol + ts->rtol * largest;
    *weighted = !error ? -1 : std::min<PetscReal>(*error / allowed, 1e10);  // PETSc takes powers of it
  });
}

// A line for every step: H, which no step raises, or the energy that the method keeps in its place.
PetscErrorCode print_energy(TS ts, PetscInt count, PetscReal t, Vec u, void*) {
  return told_to_petsc(communicator(ts), "TSMonitorEnergy_Seiche", [=] {
    if (ts->ops->step != step) return;  // of another type by now
    TsRun& run = *data_of(ts).run;
    const EnergyReading energy = run.energy(u);
    require(PetscPrintf(communicator(ts), "%" PetscInt_FMT " TS time %g H %.15g %s %.15g\n", count,
                        static_cast<double>(t), energy.H, std::string(run.method().kept_energy).c_str(),
                        energy.modified));
  });
}

PetscErrorCode set_from_options(TS ts, PetscOptionItems* PetscOptionsObject) {
  SimulationOptions& options = data_of(ts).options.simulation;
  PetscReal C = options.method_options.C.value_or(0.0);
  PetscBool has_C = PETSC_FALSE, monitor = PETSC_FALSE, has_exponential = PETSC_FALSE;
  PetscBool separable = data_of(ts).options.is_separable ? PETSC_TRUE : PETSC_FALSE;
  PetscBool ksp = data_of(ts).options.by_ksp ? PETSC_TRUE : PETSC_FALSE;
  auto degree = static_cast<PetscInt>(options.backend_options.sparse.pade_degree);
  constexpr const char* kinds[] = {"pade", "lanczos"};
  PetscInt kind = 0;
  PetscOptionsHeadBegin(PetscOptionsObject, "Splitting exponential integrators");
  PetscCall(PetscOptionsReal("-ts_seiche_C", "Shift of the scalar auxiliary variable (seisav and its family)", "", C,
                             &C, &has_C));
  PetscCall(PetscOptionsEList("-ts_seiche_exponential", "How exponentials are taken", "", kinds, 2, kinds[0], &kind,
                              &has_exponential));
  PetscCall(PetscOptionsBoundedInt("-ts_seiche_pade_degree", "Degree of Padé approximations; 0: to round-off", "",
                                   degree, &degree, nullptr, 0));
  PetscCall(PetscOptionsBool("-ts_seiche_separable", "Tell positions from momenta by the gradient of V", "", separable,
                             &separable, nullptr));
  PetscCall(PetscOptionsBool("-ts_seiche_ksp", "Solve by KSP on one process too", "", ksp, &ksp, nullptr));
  PetscCall(PetscOptionsName("-ts_seiche_monitor", "Print H and the energy that the method keeps at every step", "",
                             &monitor));
  PetscOptionsHeadEnd();
  return told_to_petsc(communicator(ts), "TSSetFromOptions_Seiche", [&] {
    if (has_C) options.method_options.C = C;
    if (has_exponential)
      options.backend_options.sparse.exponential = kind == 0 ? ExponentialKind::pade : ExponentialKind::lanczos;
    options.backend_options.sparse.pade_degree = static_cast<int>(degree);
    options.backend_options.sparse.validate();
    options.method_options.validate(find_method(options.method));
    data_of(ts).is_stale = true;
    data_of(ts).options.is_separable = separable == PETSC_TRUE;
    data_of(ts).options.by_ksp = ksp == PETSC_TRUE;
    if (monitor) require(TSMonitorSet(ts, print_energy, nullptr, nullptr));
  });
}

PetscErrorCode view(TS ts, PetscViewer viewer) {
  return told_to_petsc(communicator(ts), "TSView_Seiche", [=] {
    PetscBool is_text = PETSC_FALSE;
    require(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(viewer), PETSCVIEWERASCII, &is_text));
    if (!is_text) return;
    const MethodEntry& method = find_method(data_of(ts).options.simulation.method);
    std::string text = fmt::format("  order {}, {} propagator, keeps the energy law of {}\n  {}\n", method.order,
                                   to_string(method.propagator), method.kept_energy, method.reference);
    if (const TsRun* run = data_of(ts).run.get()) {
      const EnergyReading energy = run->energy();
      const LawPromise law = run->law(std::min(ts->max_time, 1e300));
      const Potential::Counts& counts = run->system().potential->counts();
      text += fmt::format(
          "  energy law {}: {}\n  H = {:.15g}, {} = {:.15g}\n  solver {}, {} gradients and {} values of V\n",
          law.promised ? "promised" : "not promised", law.reason, energy.H, method.kept_energy, energy.modified,
          run->solver(), counts.gradients, counts.values);
    }
    for (std::size_t begin = 0; begin < text.size();) {  // PETSc indents what is printed by one call
      const std::size_t end = text.find('\n', begin) + 1;
      require(PetscViewerASCIIPrintf(viewer, "%s", text.substr(begin, end - begin).c_str()));
      begin = end;
    }
  });
}

PetscErrorCode reset(TS ts) {
  data_of(ts).run.reset();
  return 0;
}

PetscErrorCode destroy(TS ts) {
  delete static_cast<TsData*>(ts->data);
  ts->data = nullptr;
  return PetscObjectComposeFunction(reinterpret_cast<PetscObject>(ts), "TSDiscGradSetFormulation_C", nullptr);
}

PetscErrorCode create(TS ts) {
  return told_to_petsc(communicator(ts), "TSCreate_Seiche", [ts] {
    TSType type = nullptr;
    require(TSGetType(ts, &type));
    auto data = std::make_unique<TsData>();
    data->options.simulation.method = type;
    data->options.simulation.backend = "auto";
    ts->data = data.release();
    ts->ops->setup = set_up;
    ts->ops->step = step;
    ts->ops->rollback = roll_back;
    ts->ops->interpolate = interpolate;
    ts->ops->evaluatewlte = evaluate_error;
    ts->ops->setfromoptions = set_from_options;
    ts->ops->view = view;
    ts->ops->reset = reset;
    ts->ops->destroy = destroy;
    ts->usessnes = PETSC_FALSE;
    ts->default_adapt_type = TSADAPTNONE;
    require(
        PetscObjectComposeFunction(reinterpret_cast<PetscObject>(ts), "TSDiscGradSetFormulation_C", set_formulation));
  });
}

}  // namespace
}  // namespace seiche

PetscErrorCode TSSeicheRegisterAll(void) {
  for (const seiche::MethodEntry& method : seiche::methods())
    PetscCall(TSRegister(std::string(method.name).c_str(), seiche::create));
  return 0;
}

PetscErrorCode PetscDLLibraryRegister_seiche_ts(void) { return TSSeicheRegisterAll(); }
