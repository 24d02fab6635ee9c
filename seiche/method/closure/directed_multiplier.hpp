// Directed multiplier: f = ∇V(ẑ) + λd with d = z₁ − z, where V(z⁺) − V(z) = fᵀ(z⁺ − z) fixes λ. The equation stays well
// conditioned at turning points of V, where that of the Lagrange multiplier does not.
#pragma once

#include <seiche/method/closure/closure.hpp>
#include <seiche/method/closure/multiplier.hpp>

#include <memory>
#include <optional>

namespace seiche {

class DirectedMultiplier {
 public:
  explicit DirectedMultiplier(const System& system);

  // z ← z⁺ by substeps of at least h / 2^depth: where λ is not found near 0 the substep is halved. `energy`: what H is
  // to be behind it, where the closure knows.
  StepReport advance(Vector& z, Propagators& propagators, double h, std::optional<double> energy,
                     int depth = max_depth);
  // The same, with `start` already prepared from z for h.
  StepReport finish(Vector& z, const ExplicitStep& start, Propagators& propagators, double h,
                    std::optional<double> energy, int depth = max_depth);

  void keep_ledger() { keeps_ledger_ = true; }  // as of a Closure

  static constexpr int max_depth = 8;

 private:
  const System& system_;
  ExplicitStep start_;
  MultiplierEquation equation_;
  Vector q_;
  bool keeps_ledger_ = false;
};

std::unique_ptr<Closure> make_dm_closure(const System& system);

}  // namespace seiche
