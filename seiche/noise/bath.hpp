// What dissipates in a system, with the noise that balances it.
#pragma once

#include <seiche/core/problem.hpp>
#include <seiche/core/step_cache.hpp>
#include <seiche/core/system.hpp>
#include <seiche/noise/noise.hpp>
#include <seiche/noise/random_numbers.hpp>

#include <memory>
#include <vector>

namespace seiche {

// A bath of one temperature T. Beside a damping Dz = R∇H with R = Rᵀ ⪰ 0, which acts on momenta alone, its flow is that
// of Ornstein and Uhlenbeck, exactly, and keeps exp(−H/T). Where S = Sᵀ ⪯ 0 and nothing damps it is a kick before and
// after the step, of a size with which exp(−zᵀMz/2T) is kept at any h if V = 0.
class Bath {
 public:
  // Takes the damping out of `system`, which was made of `problem` and outlives the bath: methods then step without it.
  // Throws Error where no noise balances what dissipates, or nothing does.
  Bath(System& system, const Problem& problem, const Noise& noise);

  // z ← Ψ(t, t+h)z
  void damp(double t, double h, Vector& z) const { damping_->flow(t, h, z); }
  // The noise of half a step, from t to t + h, z ← z + √T Bξ with the numbers ξ of `place`, whose seed is that of the
  // bath.
  void kick(double t, double h, RandomRow place, Vector& z);

 private:
  void require_balance(const System& system, const Problem& problem) const;
  void require_map() const;
  void set_variances(const Problem& problem);
  void draw(const RandomRow& row);
  const Vector& deviations(double t, double h);

  const Noise noise_;
  const Space& space_;
  std::function<std::unique_ptr<LinearMap>(double h)> make_map_;
  std::unique_ptr<Damping> damping_;
  bool is_damped_;     // else a gradient flow
  bool by_map_;        // else by the rates of every point
  bool rates_change_;  // in time
  StepCache<LinearMap> maps_;
  double deviations_h_ = 0;
  Vector variances_;   // T/M of every damped unknown, 0 of the others; physical
  Vector deviations_;  // √(T/M (1 − e^{−2γh}))
  Vector numbers_, kick_, mapped_;
};

}  // namespace seiche
