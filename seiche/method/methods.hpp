// The list of methods: closure × propagator × composition, and those that end their steps with a projection. One row is
// one method.
#pragma once

#include <seiche/core/stepper.hpp>
#include <seiche/core/system.hpp>
#include <seiche/method/projection/energy_law.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

enum class ClosureKind { avf, sav, lm, dm, none };
enum class Composition { whole, strang, collocation, runge_kutta, nystrom, kick, chin };
enum class AuxiliaryMode { transport, frozen, refresh };
enum class ScalarSolver { robust, newton };
enum class LinearTreatment { exact, explicit_kicks };  // e^{hL}, or kicks by all forces between drifts

struct MethodEntry {
  std::string_view name;
  ClosureKind closure;
  PropagatorKind propagator;
  Composition composition;
  int order;
  std::string_view kept_energy;  // the one that never grows: "H" or "H_modified"
  std::string_view reference;    // where the scheme comes from
  EnergyLaw projection =
      EnergyLaw::none;  // the strongest law that a projection can give it; none: it keeps one of its own

  bool projects() const { return projection != EnergyLaw::none; }
};

std::span<const MethodEntry> methods();
std::vector<std::string> method_names();
const MethodEntry& find_method(std::string_view name);  // throws Error with the nearest name

struct MethodOptions {
  std::optional<double> C;                             // sav: the shift; automatic if not given
  AuxiliaryMode auxiliary = AuxiliaryMode::transport;  // frozen, in the lm family, always solves by plain Newton
  ScalarSolver scalar_solver = ScalarSolver::robust;
  std::optional<EnergyLaw> law = {};  // of methods that project; the strongest they can have if not given

  LinearTreatment linear = LinearTreatment::exact;  // nystrom

  EnergyLaw law_of(const MethodEntry& method) const { return law.value_or(method.projection); }
  // Why no energy law is promised with these options, or "".
  std::string objection(const MethodEntry& method) const;
  bool operator==(const MethodOptions&) const = default;
  // Throws Error where an option other than its default has no meaning for the method, with the reason.
  void validate(const MethodEntry& method) const;
};

// `system` outlives the stepper; for `whole` methods it comes from with_damping_merged(problem).
std::unique_ptr<Stepper> make_stepper(const MethodEntry& method, const System& system,
                                      const MethodOptions& options = {});
// The same with errors of its steps, for variable ones.
std::unique_ptr<AdaptiveStepper> make_adaptive_stepper(const MethodEntry& method, const System& system,
                                                       const MethodOptions& options = {});

std::string to_string(ClosureKind closure);
std::string to_string(PropagatorKind propagator);
std::string to_string(Composition composition);

}  // namespace seiche
