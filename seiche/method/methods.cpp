#include <seiche/core/base/error.hpp>
#include <seiche/core/base/listed.hpp>
#include <seiche/method/adaptive/error_estimate.hpp>
#include <seiche/method/closure/avf.hpp>
#include <seiche/method/closure/directed_multiplier.hpp>
#include <seiche/method/closure/lm.hpp>
#include <seiche/method/closure/sav.hpp>
#include <seiche/method/collocation/egc.hpp>
#include <seiche/method/composition/compositions.hpp>
#include <seiche/method/method_memory.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/method/projection/projected.hpp>
#include <seiche/method/runge_kutta/exponential_runge_kutta.hpp>
#include <seiche/method/splitting/chin.hpp>
#include <seiche/method/splitting/crkn.hpp>
#include <seiche/method/splitting/strang_exact.hpp>
#include <seiche/method/unknown_method.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace seiche {
namespace {

using enum PropagatorKind;

constexpr EnergyLaw interval = EnergyLaw::interval;
constexpr EnergyLaw guard = EnergyLaw::guard;

// ---- Closures, in the whole equation with the damping merged into S, or with its flow split off

std::unique_ptr<Stepper> by_closure(const MethodEntry& method, const System& system, const MethodOptions& options) {
  std::unique_ptr<Closure> closure = method.kind.make_closure(system, settled(method, system, options));
  if (method.kind.splits_damping) return make_strang(system, method.propagator, std::move(closure));
  if (!system.damping->is_zero()) throw Error("{} needs its damping merged into S first", method.name);
  return make_whole(system, method.propagator, std::move(closure));
}

// Friction that is a flow would be a force in the formula of the estimate, which need not be smooth.
std::unique_ptr<AdaptiveStepper> with_weights(const MethodEntry& method, const System& system,
                                              const MethodOptions& options) {
  std::unique_ptr<Stepper> stepper = method.kind.make(method, system, options);
  if (!system.damping->is_linear()) return with_step_doubling(system, std::move(stepper), method.order);
  return with_error_estimate(system, std::move(stepper));
}

constexpr MethodKind avf{.closure = "avf",
                         .make = by_closure,
                         .make_adaptive = with_weights,
                         .make_closure = make_avf_closure,
                         .takes_predictor = true,
                         .members = MembersTogether::avf,
                         .doubles = 17};
constexpr MethodKind sav{.closure = "sav",
                         .make = by_closure,
                         .make_adaptive = with_weights,
                         .make_closure = make_sav_closure,
                         .takes_C = true,
                         .takes_auxiliary = true,
                         .takes_predictor = true,
                         .members = MembersTogether::sav,
                         .doubles = 11};
constexpr MethodKind lm{.closure = "lm",
                        .make = by_closure,
                        .make_adaptive = with_weights,
                        .make_closure = make_lm_closure,
                        .takes_auxiliary = true,
                        .takes_solver = true,
                        .takes_predictor = true,
                        .doubles = 23};
constexpr MethodKind dm{.closure = "dm",
                        .make = by_closure,
                        .make_adaptive = with_weights,
                        .make_closure = make_dm_closure,
                        .takes_predictor = true,
                        .doubles = 18};

constexpr MethodKind whole(MethodKind kind) {
  kind.composition = "whole";
  kind.merges_damping = true;
  return kind;
}
constexpr MethodKind strang(MethodKind kind) {
  kind.composition = "strang";
  kind.splits_damping = true;
  kind.takes_refresh = kind.takes_C;
  return kind;
}

// ---- Steps that end with a projection

std::unique_ptr<ProjectedStepper> projected(const MethodEntry& method, const System& system,
                                            const MethodOptions& options) {
  std::unique_ptr<PhiEvaluator> phi = system.make_phi();
  std::unique_ptr<BaseStep> base;
  try {
    base = method.kind.make_base(method, system, *phi, options);
  } catch (const Error& error) {
    throw Error("{} does not apply: {}", method.name, error.what());
  }
  return std::make_unique<ProjectedStepper>(system, std::move(phi), std::move(base), options.law_of(method));
}

std::unique_ptr<Stepper> by_projection(const MethodEntry& method, const System& system, const MethodOptions& options) {
  return projected(method, system, options);
}

std::unique_ptr<AdaptiveStepper> with_doubling(const MethodEntry& method, const System& system,
                                               const MethodOptions& options) {
  return with_step_doubling(system, projected(method, system, options), method.order);
}

constexpr MethodKind collocation{.composition = "collocation",
                                 .make = [](const MethodEntry& m, const System& s, const MethodOptions& o)
                                     -> std::unique_ptr<Stepper> { return make_egc(s, m.order / 2, o.law_of(m)); },
                                 .make_adaptive = [](const MethodEntry& m, const System& s,
                                                     const MethodOptions& o) -> std::unique_ptr<AdaptiveStepper> {
                                   return make_egc(s, m.order / 2, o.law_of(m));
                                 },
                                 .takes_structure = true,
                                 .holds_rate_of_start = true,
                                 .doubles_with_tables = doubles_of_collocation};
constexpr MethodKind runge_kutta{
    .composition = "runge_kutta",
    .make = by_projection,
    .make_adaptive = with_doubling,  // the weights of with_error_estimate share the errors of the midpoint rule
    .make_base =
        [](const MethodEntry& m, const System& s, const PhiEvaluator& phi, const MethodOptions&) {
          return exponential_runge_kutta(s, phi, m.order == 2 ? exponential_midpoint() : krogstad());
        },
    .takes_structure = true,
    .holds_rate_of_start = true,
    .doubles_with_tables = doubles_of_runge_kutta};
constexpr MethodKind nystrom{.composition = "nystrom",
                             .make = by_projection,
                             .make_adaptive = with_doubling,
                             .make_base =
                                 [](const MethodEntry& m, const System& s, const PhiEvaluator& phi,
                                    const MethodOptions& o) {
                                   return o.linear == LinearTreatment::exact ? conformal_nystrom(s, phi, m.order)
                                                                             : explicit_nystrom(s, phi, m.order);
                                 },
                             .takes_linear = true,
                             .takes_force = false,
                             .doubles_with_tables = doubles_of_kicks};
constexpr MethodKind strang_flow{.composition = "strang_exact",
                                 .make = by_projection,
                                 .make_adaptive = with_weights,
                                 .make_base = [](const MethodEntry& m, const System& s, const PhiEvaluator& phi,
                                                 const MethodOptions& o) { return strang_exact(s, phi, o.law_of(m)); },
                                 .doubles_with_tables = doubles_of_splitting};
constexpr MethodKind chin{.composition = "chin",
                          .make = by_projection,
                          .make_adaptive = with_doubling,
                          .make_base = [](const MethodEntry&, const System& s, const PhiEvaluator& phi,
                                          const MethodOptions&) { return chin_splitting(s, phi); },
                          .takes_force = false,
                          .splits_damping = true,
                          .doubles_with_tables = doubles_of_splitting};

// ---- The list

constexpr std::string_view paper = "Li, Li, Shang, Xu: energy-stable splitting exponential integrators";
constexpr std::string_view here = "Seiche: the paper's closure, exponential, without splitting";
constexpr std::string_view collocated = "Seiche: exponential Gauss collocation, page Theory";

// clang-format off
constexpr std::array list = {
    MethodEntry{"avf",    whole(avf),  cayley,      2, "H",          "Celledoni et al. (2012), J. Comput. Phys. 231"},
    MethodEntry{"sav",    whole(sav),  cayley,      2, "H_modified", "Shen, Xu, Yang (2019), SIAM Rev. 61"},
    MethodEntry{"lm",     whole(lm),   cayley,      2, "H",          "Cheng, Liu, Shen (2020), CMAME 367"},
    MethodEntry{"savf",   strang(avf), cayley,      2, "H",          "Liu et al. (2021), dissipation-preserving splitting"},
    MethodEntry{"ssav",   strang(sav), cayley,      2, "H_modified", paper},
    MethodEntry{"slm",    strang(lm),  cayley,      2, "H",          paper},
    MethodEntry{"eavf",   whole(avf),  exponential, 2, "H",          here},
    MethodEntry{"eisav",  whole(sav),  exponential, 2, "H_modified", paper},
    MethodEntry{"eilm",   whole(lm),   exponential, 2, "H",          paper},
    MethodEntry{"seavf",  strang(avf), exponential, 2, "H",          "Liu et al. (2021), dissipation-preserving splitting"},
    MethodEntry{"seisav", strang(sav), exponential, 2, "H_modified", paper},
    MethodEntry{"seilm",  strang(lm),  exponential, 2, "H",          paper},
    MethodEntry{"seidm",  strang(dm),  exponential, 2, "H",          "Seiche: directed multiplier, page Theory"},
    MethodEntry{"egc2",   collocation, exponential, 2, "H",          collocated, interval},
    MethodEntry{"egc4",   collocation, exponential, 4, "H",          collocated, interval},
    MethodEntry{"egc6",   collocation, exponential, 6, "H",          collocated, interval},
    MethodEntry{"egc8",   collocation, exponential, 8, "H",          collocated, interval},
    MethodEntry{"seimp",  runge_kutta, exponential, 2, "H",          "Seiche: exponential midpoint and projection", interval},
    MethodEntry{"etdrk4", runge_kutta, exponential, 4, "H",          "Krogstad (2005), J. Comput. Phys. 203; with projection", interval},
    MethodEntry{"crkn4",  nystrom,     exponential, 4, "H",          "Blanes, Moan (2002), J. Comput. Appl. Math. 142; with projection", interval},
    MethodEntry{"crkn6",  nystrom,     exponential, 6, "H",          "Blanes, Moan (2002), J. Comput. Appl. Math. 142; with projection", interval},
    MethodEntry{"strang_exact", strang_flow, exponential, 2, "H",          "Strang splitting of the linear flow; with projection", guard},
    MethodEntry{"chin4",  chin,        exponential, 4, "H",          "Seiche: positive splitting with absorbed commutator, page Theory", guard},
};
// clang-format on

void require_fit(const MethodEntry& method, const System& system) {
  if (system.structure && !method.kind.takes_structure)
    throw Error("{} needs one structure matrix S; where S changes with z use egc2 … egc8, seimp or etdrk4",
                method.name);
  if (system.force && !method.kind.takes_force)
    throw Error("{} has no place for an external force; egc2 … egc8, etdrk4, seimp and strang_exact take it",
                method.name);
}

}  // namespace

std::span<const MethodEntry> methods() { return list; }

std::vector<std::string> method_names() { return names_of(methods()); }

const MethodEntry& find_method(std::string_view name) {
  if (const MethodEntry* entry = find_row(methods(), name)) return *entry;
  throw unknown_method(name);
}

EnergyLaw MethodOptions::law_of(const MethodEntry& method) const { return law.value_or(method.projection); }

void MethodOptions::validate(const MethodEntry& method) const {
  if (law && !method.projects())
    throw Error("law belongs to the methods that end with a projection; {} keeps the law of its own scheme",
                method.name);
  if (law && *law < method.projection)
    throw Error(
        "law = \"{}\" is more than {} can have, which knows no values inside a step to integrate the dissipation by; use \"{}\" or \"none\"",
        to_string(*law), method.name, to_string(method.projection));
  const MethodKind& kind = method.kind;
  if (C && !kind.takes_C) throw Error("C belongs to the sav family; {} has no auxiliary variable", method.name);
  if (C && !std::isfinite(*C)) throw Error("C = {} must be a finite number or \"auto\"", *C);
  if (scalar_solver != ScalarSolver::robust && !kind.takes_solver)
    throw Error("scalar_solver = \"newton\" belongs to the lm family; {} solves no equation for η", method.name);
  if (linear != LinearTreatment::exact && !kind.takes_linear)
    throw Error("linear = \"explicit\" belongs to crkn4 and crkn6; {} takes the linear part in one piece", method.name);
  if (predictor != Predictor::remembered && !kind.takes_predictor)
    throw Error("predictor = \"gradient\" belongs to the avf, sav, lm and dm families; {} does not predict a midpoint",
                method.name);
  if (auxiliary == AuxiliaryMode::automatic || auxiliary == AuxiliaryMode::transport) return;
  if (!kind.takes_auxiliary)
    throw Error("auxiliary belongs to the sav and lm families; {} carries no auxiliary through the damping",
                method.name);
  if (auxiliary == AuxiliaryMode::relaxed && !kind.takes_C)
    throw Error("auxiliary = \"relaxed\" belongs to the sav family; the law of {} is that of H itself", method.name);
  if (auxiliary != AuxiliaryMode::refresh || kind.takes_refresh) return;
  if (!kind.takes_C)
    throw Error("auxiliary = \"refresh\" has no meaning for {}: V is not carried; use \"transport\" or \"frozen\"",
                method.name);
  throw Error("auxiliary = \"refresh\" acts after the damping flows, and {} has none", method.name);
}

MethodOptions settled(const MethodEntry& method, const System& system, MethodOptions options) {
  if (options.auxiliary != AuxiliaryMode::automatic) return options;
  const bool relaxes = method.kind.takes_C && !method.kind.merges_damping && is_gradient_flow(system);
  options.auxiliary = relaxes ? AuxiliaryMode::relaxed : AuxiliaryMode::transport;
  return options;
}

MethodOptions MethodOptions::meant_for(const MethodEntry& method) const {
  const MethodKind& kind = method.kind;
  MethodOptions own;
  if (kind.takes_C) own.C = C;
  if (kind.takes_auxiliary) own.auxiliary = auxiliary;
  if (kind.takes_solver) own.scalar_solver = scalar_solver;
  if (kind.takes_linear) own.linear = linear;
  if (kind.takes_predictor) own.predictor = predictor;
  if (law && method.projects()) own.law = std::max(*law, method.projection);
  return own;
}

std::string MethodOptions::objection(const MethodEntry& method) const {
  if (auxiliary == AuxiliaryMode::refresh)
    return "auxiliary = \"refresh\" resets r after the damping, and the modified energy may rise there";
  const bool frozen = auxiliary == AuxiliaryMode::frozen;
  if (scalar_solver == ScalarSolver::newton || (method.kind.takes_solver && frozen))
    return "plain Newton accepts steps whose scalar equation it did not solve";
  if (method.projects() && law_of(method) == EnergyLaw::none)
    return "law = \"none\" switches off the projection that keeps it";
  return "";
}

std::unique_ptr<Stepper> make_stepper(const MethodEntry& method, const System& system, const MethodOptions& options) {
  options.validate(method);
  require_fit(method, system);
  return method.kind.make(method, system, options);
}

std::unique_ptr<AdaptiveStepper> make_adaptive_stepper(const MethodEntry& method, const System& system,
                                                       const MethodOptions& options) {
  options.validate(method);
  require_fit(method, system);
  return method.kind.make_adaptive(method, system, options);
}

std::string to_string(PropagatorKind propagator) { return propagator == exponential ? "exponential" : "cayley"; }

}  // namespace seiche
