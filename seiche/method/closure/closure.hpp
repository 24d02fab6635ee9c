// A closure chooses the force f of the Hamiltonian substep z⁺ = Ez + Ff, and with it the energy that the substep keeps.
#pragma once

#include <seiche/core/propagator.hpp>
#include <seiche/core/state.hpp>
#include <seiche/core/stepper.hpp>
#include <seiche/core/system.hpp>
#include <seiche/method/closure/midpoint_predictor.hpp>

namespace seiche {

class Closure {
 public:
  Closure(const System& system, Predictor predictor) : system_(system), predictor_(system, predictor) {}
  virtual ~Closure() = default;

  virtual void begin(State& s) { predictor_.begin(s); }
  virtual void restart(State& s) { begin(s); }  // as Stepper::restart
  // A damping half-flow, z ← Ψ(t, t+h)z, with what the closure carries beside z.
  virtual void damp(State& s, double t, double h) { system_.damping->flow(t, h, s.z); }
  // The external force over h, z += ∫f, likewise. Only where the system has one.
  virtual void impulse(State& s, double t, double h) { system_.force->impulse(t, h, s.z); }
  // The Hamiltonian substep of length h within the step that starts at t. On failure s is left in any state.
  virtual StepReport advance(State& s, Propagators& propagators, double t, double h) = 0;
  // Behind a step that succeeded as a whole: what the closure carries beside z may move.
  virtual void settle(State& /*s*/) {}
  // Behind a step of length h that succeeded as a whole: what the next one is to remember of it.
  void keep(State& s, double h) { predictor_.keep(s, h, midpoint_gradient()); }

  // Damping half-flows around a substep, where each multiplies every field by a number.
  struct HalfFlows {
    Propagator::FieldFactors before, after;
    State* between = nullptr;  // if given, becomes the state between the substep and the flow after it
  };
  // Substep and half-flows in one, for closures that save passes over z by it. On failure s is left as it was.
  virtual bool takes_half_flows() const { return false; }
  virtual StepReport advance_damped(State& s, Propagators& propagators, double t, double h, const HalfFlows& flows);
  EnergyReading energy(const State& s) const;
  virtual bool has_modified_energy() const { return false; }
  // From now on `advance` fills `scalar` of the ledger in its report: what its energy changes beside the dissipation of
  // S.
  virtual void keep_ledger() { keeps_ledger_ = true; }
  virtual void expect(double /*error_rate*/) {}  // as Stepper::expect

 protected:
  // No damping, no force, S skew: H of a solution stays, and so does a drift by round-off, which then adds up.
  bool nothing_changes_H() const;
  bool keeps_ledger() const { return keeps_ledger_; }
  // Replaces H, which stands there, by the modified energy and its round-off.
  virtual void read_modified(const State&, const ValueAndMagnitude& /*quadratic*/, EnergyReading&) const {}
  MidpointPredictor& predictor() { return predictor_; }
  virtual Vector& midpoint_gradient() = 0;  // ĝ of the last substep
  const System& system() const { return system_; }
  const Potential& potential() const { return *system_.potential; }
  const Space& space() const { return *system_.space; }

 private:
  const System& system_;
  MidpointPredictor predictor_;
  bool keeps_ledger_ = false;
};

// What round-off may make of a mean gradient from z: eight times Potential::gradient_round_off, since the terms of a
// mean may cancel elsewhere. z is the start of a step; an iterate of a solver may be anywhere.
void bound_mean_gradient(const Potential& potential, const Vector& z, Vector& bounds);

// The explicit step z₁ = Ez + F∇V(ẑ) that every closure starts from, and its parts.
struct ExplicitStep {
  explicit ExplicitStep(Index size);
  // Fills everything below ẑ, from ẑ and z; returns V(ẑ).
  double prepare(const Potential& potential, const Propagator& propagator, const Vector& z);

  Vector z_mid;   // ẑ
  Vector g;       // ĝ = ∇V(ẑ)
  Vector dz;      // FMz = (E − I)z
  Vector q;       // Fĝ
  Vector delta;   // δ₁ = dz + q
  Vector z_plus;  // z₁ = z + δ₁
};

}  // namespace seiche
