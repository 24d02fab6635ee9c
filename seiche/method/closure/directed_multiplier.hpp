// Directed multiplier: f = ∇V(ẑ) + λd with d = z₁ − z, where V(z⁺) − V(z) = fᵀ(z⁺ − z) fixes λ. The equation stays well
// conditioned at turning points of V, where that of the Lagrange multiplier does not.
#pragma once

#include <seiche/method/closure/closure.hpp>
#include <seiche/method/closure/multiplier.hpp>
#include <seiche/method/common/method_options.hpp>

#include <memory>
#include <optional>

namespace seiche {

class DirectedMultiplier {
 public:
  explicit DirectedMultiplier(const System& system);

  // s.z ← z⁺ by substeps of at least h / 2^max_depth: where λ is not found near 0 the substep is halved. `energy`: what
  // H is to be behind it, where the closure knows.
  StepReport advance(State& s, MidpointPredictor& predictor, Propagators& propagators, double h,
                     std::optional<double> energy);
  // The same, with `start` already prepared from z for h.
  StepReport finish(Vector& z, const ExplicitStep& start, Propagators& propagators, double h,
                    std::optional<double> energy, int depth = max_depth);

  void keep_ledger() { keeps_ledger_ = true; }      // as of a Closure
  Vector& midpoint_gradient() { return start_.g; }  // of the last substep that `advance` took

  static constexpr int max_depth = 8;

 private:
  StepReport advance_half(Vector& z, Propagators& propagators, double h, std::optional<double> energy, int depth);

  const System& system_;
  ExplicitStep start_;
  MultiplierEquation equation_;
  Vector q_;
  bool keeps_ledger_ = false;
};

std::unique_ptr<Closure> make_dm_closure(const System& system, const MethodOptions& options);

}  // namespace seiche
