// What a method can be asked for beside its row of the list.
#pragma once

#include <seiche/method/common/energy_law.hpp>

#include <optional>
#include <string>

namespace seiche {

struct MethodEntry;

enum class AuxiliaryMode { transport, frozen, refresh };
enum class ScalarSolver { robust, newton };
enum class Predictor { gradient, remembered };         // seiche/method/closure/midpoint_predictor.hpp
enum class LinearTreatment { exact, explicit_kicks };  // e^{hL}, or kicks by all forces between drifts

struct MethodOptions {
  std::optional<double> C;                             // sav: the shift; automatic if not given
  AuxiliaryMode auxiliary = AuxiliaryMode::transport;  // frozen, in the lm family, always solves by plain Newton
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
