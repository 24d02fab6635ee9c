#include <seiche/core/error.hpp>
#include <seiche/method/adaptive/error_estimate.hpp>
#include <seiche/method/closure/avf.hpp>
#include <seiche/method/closure/directed_multiplier.hpp>
#include <seiche/method/closure/lm.hpp>
#include <seiche/method/closure/sav.hpp>
#include <seiche/method/collocation/egc.hpp>
#include <seiche/method/composition/compositions.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/method/projection/projected.hpp>
#include <seiche/method/runge_kutta/exponential_runge_kutta.hpp>
#include <seiche/method/splitting/chin.hpp>
#include <seiche/method/splitting/crkn.hpp>
#include <seiche/method/splitting/strang_exact.hpp>

#include <array>
#include <cmath>

namespace seiche {
namespace {

using enum ClosureKind;
using enum PropagatorKind;
using enum Composition;

constexpr EnergyLaw interval = EnergyLaw::interval;
constexpr EnergyLaw guard = EnergyLaw::guard;

constexpr std::string_view paper = "Li, Li, Shang, Xu: energy-stable splitting exponential integrators";
constexpr std::string_view here = "Seiche: the paper's closure, exponential, without splitting";

constexpr std::string_view collocated = "Seiche: exponential Gauss collocation, page Theory";

// clang-format off
constexpr std::array list = {
    MethodEntry{"avf",    avf, cayley,      whole,  2, "H",          "Celledoni et al. (2012), J. Comput. Phys. 231"},
    MethodEntry{"sav",    sav, cayley,      whole,  2, "H_modified", "Shen, Xu, Yang (2019), SIAM Rev. 61"},
    MethodEntry{"lm",     lm,  cayley,      whole,  2, "H",          "Cheng, Liu, Shen (2020), CMAME 367"},
    MethodEntry{"savf",   avf, cayley,      strang, 2, "H",          "Liu et al. (2021), dissipation-preserving splitting"},
    MethodEntry{"ssav",   sav, cayley,      strang, 2, "H_modified", paper},
    MethodEntry{"slm",    lm,  cayley,      strang, 2, "H",          paper},
    MethodEntry{"eavf",   avf, exponential, whole,  2, "H",          here},
    MethodEntry{"eisav",  sav, exponential, whole,  2, "H_modified", paper},
    MethodEntry{"eilm",   lm,  exponential, whole,  2, "H",          paper},
    MethodEntry{"seavf",  avf, exponential, strang, 2, "H",          "Liu et al. (2021), dissipation-preserving splitting"},
    MethodEntry{"seisav", sav, exponential, strang, 2, "H_modified", paper},
    MethodEntry{"seilm",  lm,  exponential, strang, 2, "H",          paper},
    MethodEntry{"seidm",  dm,  exponential, strang, 2, "H",          "Seiche: directed multiplier, page Theory"},
    MethodEntry{"egc2",   none, exponential, collocation, 2, "H",    collocated, interval},
    MethodEntry{"egc4",   none, exponential, collocation, 4, "H",    collocated, interval},
    MethodEntry{"egc6",   none, exponential, collocation, 6, "H",    collocated, interval},
    MethodEntry{"egc8",   none, exponential, collocation, 8, "H",    collocated, interval},
    MethodEntry{"seimp",  none, exponential, runge_kutta, 2, "H",    "Seiche: exponential midpoint and projection", interval},
    MethodEntry{"etdrk4", none, exponential, runge_kutta, 4, "H",    "Krogstad (2005), J. Comput. Phys. 203; with projection", interval},
    MethodEntry{"crkn4",  none, exponential, nystrom, 4, "H",        "Blanes, Moan (2002), J. Comput. Appl. Math. 142; with projection", interval},
    MethodEntry{"crkn6",  none, exponential, nystrom, 6, "H",        "Blanes, Moan (2002), J. Comput. Appl. Math. 142; with projection", interval},
    MethodEntry{"strang_exact", none, exponential, kick, 2, "H",     "Strang splitting of the linear flow; with projection", guard},
    MethodEntry{"chin4",  none, exponential, chin, 4, "H",           "Seiche: positive splitting with absorbed commutator, page Theory", guard},
};
// clang-format on

std::unique_ptr<Closure> make_closure(const MethodEntry& method, const System& system, const MethodOptions& options) {
  switch (method.closure) {
    case avf: return make_avf_closure(system);
    case sav: return make_sav_closure(system, options);
    case lm: return make_lm_closure(system, options);
    case dm: return make_dm_closure(system);
    case none: break;
  }
  throw Error("method {} has no closure", method.name);
}

std::unique_ptr<BaseStep> make_base(const MethodEntry& method, const System& system, const PhiEvaluator& phi,
                                    const MethodOptions& options) {
  switch (method.composition) {
    case runge_kutta:
      return exponential_runge_kutta(system, phi, method.order == 2 ? exponential_midpoint() : krogstad());
    case nystrom:
      return options.linear == LinearTreatment::exact ? conformal_nystrom(system, phi, method.order)
                                                      : explicit_nystrom(system, phi, method.order);
    case kick: return strang_exact(system, phi);
    case chin: return chin_splitting(system, phi);
    case whole:
    case strang:
    case collocation: break;
  }
  throw Error("method {} is no base step with a projection", method.name);
}

void require_fit(const MethodEntry& method, const System& system) {
  if (system.structure && method.composition != collocation && method.composition != runge_kutta)
    throw Error("{} needs one structure matrix S; where S changes with z use egc2 … egc8, seimp or etdrk4",
                method.name);
  if (system.force && (method.composition == nystrom || method.composition == chin))
    throw Error("{} has no place for an external force; egc2 … egc8, etdrk4, seimp and strang_exact take it",
                method.name);
}

std::unique_ptr<ProjectedStepper> make_projected(const MethodEntry& method, const System& system,
                                                 const MethodOptions& options) {
  std::unique_ptr<PhiEvaluator> phi = system.make_phi();
  std::unique_ptr<BaseStep> base;
  try {
    base = make_base(method, system, *phi, options);
  } catch (const Error& error) {
    throw Error("{} does not apply: {}", method.name, error.what());
  }
  return std::make_unique<ProjectedStepper>(system, std::move(phi), std::move(base), options.law_of(method));
}

}  // namespace

std::span<const MethodEntry> methods() { return list; }

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const MethodEntry& entry : list) names.emplace_back(entry.name);
  return names;
}

const MethodEntry& find_method(std::string_view name) {
  for (const MethodEntry& entry : list)
    if (entry.name == name) return entry;
  throw unknown_name("method", name, method_names());
}

void MethodOptions::validate(const MethodEntry& method) const {
  if (law && !method.projects())
    throw Error("law belongs to the methods that end with a projection; {} keeps the law of its own scheme",
                method.name);
  if (law && *law < method.projection)
    throw Error(
        "law = \"{}\" is more than {} can have, which knows no values inside a step to integrate the dissipation by; use \"{}\" or \"none\"",
        to_string(*law), method.name, to_string(method.projection));
  if (C) {
    if (method.closure != sav) throw Error("C belongs to the sav family; {} has no auxiliary variable", method.name);
    if (!std::isfinite(*C)) throw Error("C = {} must be a finite number or \"auto\"", *C);
  }
  if (scalar_solver == ScalarSolver::newton && method.closure != lm) {
    throw Error("scalar_solver = \"newton\" belongs to the lm family; {} solves no equation for η", method.name);
  }
  if (linear == LinearTreatment::explicit_kicks && method.composition != nystrom)
    throw Error("linear = \"explicit\" belongs to crkn4 and crkn6; {} takes the linear part in one piece", method.name);
  if (auxiliary == AuxiliaryMode::transport) return;
  if (method.closure == avf || method.closure == dm || method.closure == none) {
    throw Error("auxiliary belongs to the sav and lm families; {} carries no auxiliary through the damping",
                method.name);
  }
  if (auxiliary == AuxiliaryMode::refresh && method.closure == lm) {
    throw Error("auxiliary = \"refresh\" has no meaning for {}: V is not carried; use \"transport\" or \"frozen\"",
                method.name);
  }
  if (auxiliary == AuxiliaryMode::refresh && method.composition == whole) {
    throw Error("auxiliary = \"refresh\" acts after the damping flows, and {} has none", method.name);
  }
}

std::string MethodOptions::objection(const MethodEntry& method) const {
  if (auxiliary == AuxiliaryMode::refresh)
    return "auxiliary = \"refresh\" resets r after the damping, and the modified energy may rise there";
  const bool frozen = auxiliary == AuxiliaryMode::frozen;
  if (scalar_solver == ScalarSolver::newton || (method.closure == lm && frozen))
    return "plain Newton accepts steps whose scalar equation it did not solve";
  if (method.projects() && law_of(method) == EnergyLaw::none)
    return "law = \"none\" switches off the projection that keeps it";
  return "";
}

std::unique_ptr<Stepper> make_stepper(const MethodEntry& method, const System& system, const MethodOptions& options) {
  options.validate(method);
  require_fit(method, system);
  if (method.composition == collocation) return make_egc(system, method.order / 2, options.law_of(method));
  if (method.projects()) return make_projected(method, system, options);
  if (method.composition == whole) {
    if (!system.damping->is_zero()) throw Error("{} needs its damping merged into S first", method.name);
    return make_whole(system, method.propagator, make_closure(method, system, options));
  }
  return make_strang(system, method.propagator, make_closure(method, system, options));
}

std::unique_ptr<AdaptiveStepper> make_adaptive_stepper(const MethodEntry& method, const System& system,
                                                       const MethodOptions& options) {
  options.validate(method);
  require_fit(method, system);
  if (method.composition == collocation) return make_egc(system, method.order / 2, options.law_of(method));
  // The weights of with_error_estimate stand on the same midpoint as those of the midpoint rule, and share its errors.
  if (method.order > 2 || method.composition == runge_kutta)
    return with_step_doubling(system, make_projected(method, system, options), method.order);
  // Friction that is a flow here would be a force in that formula, which need not be smooth.
  if (!system.damping->is_linear())
    return with_step_doubling(system, make_stepper(method, system, options), method.order);
  return with_error_estimate(system, make_stepper(method, system, options));
}

std::string to_string(ClosureKind closure) {
  constexpr std::array names = {"avf", "sav", "lm", "dm", "none"};
  return names[static_cast<std::size_t>(closure)];
}

std::string to_string(PropagatorKind propagator) { return propagator == exponential ? "exponential" : "cayley"; }

std::string to_string(Composition composition) {
  constexpr std::array names = {"whole", "strang", "collocation", "runge_kutta", "nystrom", "kick", "chin"};
  return names[static_cast<std::size_t>(composition)];
}

}  // namespace seiche
