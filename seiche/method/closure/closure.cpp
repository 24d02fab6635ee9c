#include <seiche/core/base/error.hpp>
#include <seiche/core/generic_state.hpp>
#include <seiche/method/closure/closure.hpp>

#include <cmath>

namespace seiche {

StepReport Closure::advance_damped(State&, Propagators&, double, double, const HalfFlows&) {
  throw Error("this closure does not carry out half-flows");
}

EnergyReading Closure::energy(const State& s) const {
  const EnergyTerms terms = system_.energy_terms(s.z);
  EnergyReading reading;
  reading.H = reading.modified = terms.sum();
  reading.round_off = reading.modified_round_off = terms.round_off();
  reading.size = terms.size();
  read_modified(s, terms.quadratic, reading);
  return reading;
}

bool Closure::nothing_changes_H() const {
  if (!system_.damping->is_zero() || system_.force || system_.structure) return false;
  // zᵀSz = 0, tried with one vector without symmetries.
  const Vector z = generic_state(*system_.space);
  Vector Sz(z.size());
  system_.linear->apply_S(z, Sz);
  return std::abs(space().dot(z, Sz)) <= 1e-13 * space().norm(z) * space().norm(Sz);
}

void bound_mean_gradient(const Potential& potential, const Vector& z, Vector& bounds) {
  potential.gradient_round_off(z, bounds);
  bounds *= 8 * epsilon;
}

ExplicitStep::ExplicitStep(Index size) {
  for (Vector* v : {&z_mid, &g, &dz, &q, &delta, &z_plus}) v->setZero(size);
}

double ExplicitStep::prepare(const Potential& potential, const Propagator& propagator, const Vector& z) {
  const double v_mid = potential.value_and_gradient(z_mid, g);
  propagator.increment(z, dz);
  propagator.force(g, q);
  delta = dz + q;
  z_plus = z + delta;
  return v_mid;
}

}  // namespace seiche
