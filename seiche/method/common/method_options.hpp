// What a method can be asked for beside its row of the list.
#pragma once

#include <seiche/method/common/energy_law.hpp>

#include <optional>
#include <string>

namespace seiche {

struct MethodEntry;

// What becomes of r² of the sav family beside a substep: damping moves it as it moves V (transport); besides, a step
// ends with r² moved towards V + C (relaxed); nothing does (frozen); it is V + C behind every half-flow (refresh).
// automatic: relaxed by methods that split the damping off, of gradient flows (S = Sᵀ), else transport.
enum class AuxiliaryMode { automatic, transport, relaxed, frozen, refresh };
enum class ScalarSolver { robust, newton };
enum class Predictor { gradient, remembered };         // seiche/method/closure/midpoint_predictor.hpp
enum class LinearTreatment { exact, explicit_kicks };  // e^{hL}, or kicks by all forces between drifts

struct MethodOptions {
  std::optional<double> C;                             // sav: the shift; automatic if not given
  AuxiliaryMode auxiliary = AuxiliaryMode::automatic;  // frozen, in the lm family, always solves by plain Newton
  ScalarSolver scalar_solver = ScalarSolver::robust;
  std::optional<EnergyLaw> law = {};  // of methods that project; the strongest they can have if not given

  LinearTreatment linear = LinearTreatment::exact;  // of crkn4 and crkn6
  Predictor predictor = Predictor::remembered;      // of closures

  EnergyLaw law_of(const MethodEntry& method) const;
  // Why no energy law is promised with these options, or "".
  std::string objection(const MethodEntry& method) const;
  bool operator==(const MethodOptions&) const = default;
  // Throws Error where an option other than its default has no meaning for the method, with the reason.
  void validate(const MethodEntry& method) const;
  // Without those that have no meaning for the method, and with a law that it can have.
  MethodOptions meant_for(const MethodEntry& method) const;
};

}  // namespace seiche
