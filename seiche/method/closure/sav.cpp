#include <seiche/core/base/error.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/method/closure/sav.hpp>
#include <seiche/method/closure/sav_algebra.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

class SavClosure final : public Closure {
 public:
  SavClosure(const System& system, const MethodOptions& options)
      : Closure(system, options.predictor),
        given_C_(options.C),
        auxiliary_(options.auxiliary),
        g_(Vector::Zero(system.space->size())),
        pushed_(g_),
        physical_(Vector::Zero(system.space->physical_size())) {}

  void begin(State& s) override;
  void restart(State& s) override;
  void damp(State& s, double t, double h) override;
  void impulse(State& s, double t, double h) override;
  StepReport advance(State& s, Propagators& propagators, double t, double h) override {
    return advance_damped(s, propagators, t, h, {});
  }
  // r² does not move with half-flows that leave V alone.
  bool takes_half_flows() const override {
    return !system().damping->touches_potential() && auxiliary_ != AuxiliaryMode::refresh;
  }
  StepReport advance_damped(State& s, Propagators& propagators, double t, double h, const HalfFlows& flows) override;
  void settle(State& s) override;
  bool has_modified_energy() const override { return true; }
  void expect(double error_rate) override { error_rate_ = error_rate; }

 protected:
  void read_modified(const State& s, const ValueAndMagnitude& quadratic, EnergyReading& reading) const override;

 private:
  Vector& midpoint_gradient() override { return g_; }
  bool relaxes() const { return auxiliary_ == AuxiliaryMode::relaxed; }
  bool transports() const { return auxiliary_ == AuxiliaryMode::transport || relaxes(); }
  double modified_energy(const State& s) const {
    return system().linear->quadratic_energy(s.z) + (s.r_squared - s.shift);
  }
  double drift(const State& s) const;
  double margin_against_drift(double drift, double margin);

  std::optional<double> given_C_;
  AuxiliaryMode auxiliary_;
  double error_rate_ = 0;  // that steps may have; 0: not given
  Vector g_, pushed_, physical_;
};

// C = 2E₀ keeps V + C well away from 0 where √(V + C) would lose digits, without losing the digits of V to C.
void SavClosure::begin(State& s) {
  Closure::begin(s);
  const double v = potential().value(s.z);
  s.energy_scale = system().linear->quadratic_energy(s.z) + std::abs(v);
  s.shift = given_C_.value_or(s.energy_scale > 0 ? 2 * s.energy_scale : 1.0);
  s.r_squared = v + s.shift;
  constexpr double largest = 1e10;
  if (given_C_ && s.energy_scale > 0 && std::abs(s.shift) > largest * s.energy_scale) {
    throw Error("C = {} leaves the energy {:.6g} fewer than six digits; give at most {:.3g}, or C = \"auto\"", s.shift,
                s.energy_scale, largest * s.energy_scale);
  }
  if (!(s.r_squared > 0)) {
    throw Error("C = {} is too small: V(z₀) + C = {:.6g} must be > 0; C = {:.6g} would do, or C = \"auto\"", s.shift,
                s.r_squared, 2 * s.energy_scale);
  }
  if (relaxes()) s.energy = modified_energy(s);
}

// C stays: it is for the size of energies, and not for one state.
void SavClosure::restart(State& s) {
  Closure::begin(s);
  s.r_squared = potential().value(s.z) + s.shift;
  if (relaxes()) s.energy = modified_energy(s);
}

// The damping flow must change H̃ by what it changes H: r² moves with V (transport). The paper keeps r (frozen), which
// is consistent only where the damping does not touch V.
void SavClosure::damp(State& s, double t, double h) {
  const bool transports = this->transports() && system().damping->touches_potential();
  const double v_before = transports ? potential().value(s.z) : 0.0;
  Closure::damp(s, t, h);
  if (transports) s.r_squared += potential().value(s.z) - v_before;
  if (auxiliary_ == AuxiliaryMode::refresh) s.r_squared = potential().value(s.z) + s.shift;
}

void SavClosure::impulse(State& s, double t, double h) {
  const bool transports = system().force->touches_potential();
  const double v_before = transports ? potential().value(s.z) : 0.0;
  const double before = relaxes() ? modified_energy(s) : 0.0;
  Closure::impulse(s, t, h);
  if (transports) s.r_squared += potential().value(s.z) - v_before;
  if (relaxes()) s.energy += modified_energy(s) - before;  // work of the force, and no dissipation
}

// r² moves to V + C, or up towards it by a share of what the step has taken from H̃, which so does not rise (Jiang,
// Zhang, Zhao, J. Comput. Phys. 456 (2022) 110954).
void SavClosure::settle(State& s) {
  if (!relaxes()) return;
  constexpr double share = 0.95;
  const double modified = modified_energy(s);
  const double missing = potential().value(s.z) + s.shift - s.r_squared;
  const double moves = std::min(missing, share * std::max(s.energy - modified, 0.0));
  if (std::isfinite(moves)) s.r_squared += moves;  // else the next step says what is wrong
  s.energy = modified + (std::isfinite(moves) ? moves : 0.0);
}

// r² − (V + C) where an error rate is given; else 0.
double SavClosure::drift(const State& s) const {
  return error_rate_ > 0 ? s.r_squared - (potential().value(s.z) + s.shift) : 0;
}

// The errors of all steps are left in r² − (V + C) = δ, and the force is r/√(V + C) ≈ 1 + δ/(2(V + C)) times what it
// should be: an error per unit of time that no step size lowers, and a larger C does. Returns the V + C from which on
// it is a small share of what steps may have, for ĝ in g_; or something smaller than `margin`, if that is enough.
double SavClosure::margin_against_drift(double drift, double margin) {
  constexpr double share = 0.1;
  system().linear->apply_S(g_, pushed_);
  const double wanted = std::abs(drift) / (2 * share * error_rate_);
  if (wanted * space().norm(pushed_) < margin) return 0;  // which bounds the max norm, and saves a transform
  space().to_physical(pushed_, physical_);
  return wanted * space().max_norm(physical_);
}

StepReport not_finite(double v_mid, double t, double h) {
  return {.status = StepReport::Status::failed,
          .message = fmt::format("the solution is no longer finite: V(ẑ) = {} at t = {:.6g} with h = {:.6g}",
                                 number_text(v_mid), t, h)};
}

StepReport no_force(const State& s, double v_mid, double t, double h) {
  const double above = v_mid + s.shift;
  if (above > 0) return not_finite(v_mid, t, h);
  return {.status = StepReport::Status::failed,
          .message = fmt::format("V(ẑ) + C = {:.6g} must be > 0 at t = {:.6g}; C = {:.6g} would do", above, t,
                                 s.shift + 2 * (s.energy_scale + std::abs(v_mid)))};
}

//   z⁺ = Ez⁻ + F r̄g,   r⁺ − r⁻ = ½gᵀ(z⁺ − z⁻),   r̄ = ½(r⁺ + r⁻),   g = ĝ/√(V(ẑ) + C),   ĝ = ∇V(ẑ)
StepReport SavClosure::advance_damped(State& s, Propagators& propagators, double t, double h, const HalfFlows& flows) {
  const Propagator& propagator = propagators.at(h);
  Vector &z_mid = g_, &g = g_;  // one buffer: ẑ, then ĝ
  const double drift = this->drift(s);
  predictor().predict(s, propagator, h, z_mid, flows.before);     // ẑ
  const double v_mid = potential().value_and_gradient(z_mid, g);  // V(ẑ) and ĝ
  if (!std::isfinite(v_mid)) return not_finite(v_mid, t, h);
  const Propagator::Powers power = propagator.powers(s.z, g, flows.before);  // ĝᵀFMz⁻ and ĝᵀFĝ, of (3.3)

  SavAuxiliary a{s.r_squared, s.shift, s.energy_scale};
  const double against_drift = drift != 0 ? margin_against_drift(drift, v_mid + s.shift) : 0;
  double rise = 0;
  if (auxiliary_ != AuxiliaryMode::frozen) rise = sav_algebra::rise(a, v_mid, power.quadratic_energy, against_drift);
  if (rise != 0) [[unlikely]] {  // so that r̄ does not wait for it
    a.r_squared += rise;
    a.shift += rise;
  }
  const sav_algebra::Force force = sav_algebra::force(a, v_mid, power.of_increment, power.of_force);  // r̄, r⁺: (3.1b)
  if (!std::isfinite(force.factor)) return no_force(s, v_mid, t, h);

  s.r_squared = force.r_squared;
  s.shift = a.shift;
  if (flows.between != nullptr) {
    flows.between->z = s.z;
    flows.between->r_squared = s.r_squared;
    flows.between->shift = s.shift;
    propagator.update(flows.between->z, g, force.factor, flows.before);
  }
  propagator.update(s.z, g, force.factor, flows.before, flows.after);  // z⁺ = Ez⁻ + F r̄g: (3.1a), (4.2)
  return {.fallbacks = rise != 0 ? 1 : 0};
}

void SavClosure::read_modified(const State& s, const ValueAndMagnitude& quadratic, EnergyReading& reading) const {
  reading.modified = quadratic.value + (s.r_squared - s.shift);
  reading.modified_round_off = 50 * epsilon * (2 * quadratic.magnitude + std::abs(s.r_squared) + std::abs(s.shift));
}

}  // namespace

std::unique_ptr<Closure> make_sav_closure(const System& system, const MethodOptions& options) {
  return std::make_unique<SavClosure>(system, options);
}

}  // namespace seiche
