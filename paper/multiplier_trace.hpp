// The multiplier η of SEILM, step by step, recovered from the states alone: a step is z₁ = Ez⁻ + ηFĝ with z⁻ = Ψzⁿ and
// zⁿ⁺¹ = Ψz₁, so that η = qᵀ(z₁ − Ez⁻)/qᵀq with q = Fĝ. Where the robust solver took another force than ηĝ this is
// the part of it along ĝ.
#pragma once

#include <seiche/core/observer.hpp>
#include <seiche/simulation/simulation.hpp>

#include <vector>

namespace seiche {

class MultiplierTrace final : public Observer {
 public:
  MultiplierTrace(const System& system, double h);

  bool is_due(const State&, bool) const override { return true; }
  void observe(const State& state, const EnergyReading& energy) override;
  void finish(const RunReport&) override {}

  const std::vector<double>& t() const { return t_; }  // at the end of each step
  const std::vector<double>& eta() const { return eta_; }

 private:
  const System& system_;
  double h_;
  std::unique_ptr<Propagator> propagator_;
  Vector previous_, gradient_, z_mid_, increment_, q_, arrived_;
  std::vector<double> t_, eta_;
};

}  // namespace seiche
