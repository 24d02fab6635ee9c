#include <paper/multiplier_trace.hpp>

namespace seiche {

MultiplierTrace::MultiplierTrace(const System& system, double h)
    : system_(system), h_(h), propagator_(system.linear->propagator(PropagatorKind::exponential, h)) {
  for (Vector* v : {&gradient_, &z_mid_, &increment_, &q_}) v->setZero(system.space->size());
}

void MultiplierTrace::observe(const State& state, const EnergyReading&) {
  if (state.n > 0) {
    const double t = state.t - h_;
    system_.damping->flow(t, h_ / 2, previous_);  // z⁻
    system_.potential->gradient(previous_, gradient_);
    propagator_->predict(previous_, gradient_, z_mid_);
    system_.potential->gradient(z_mid_, gradient_);
    propagator_->increment(previous_, increment_);
    propagator_->force(gradient_, q_);
    arrived_ = state.z;
    system_.damping->flow(state.t, -h_ / 2, arrived_);  // Ψ⁻¹
    const double length = q_.dot(q_);
    if (length > 0) {
      t_.push_back(state.t);
      eta_.push_back(q_.dot(arrived_ - previous_ - increment_) / length);
    }
  }
  previous_ = state.z;
}

}  // namespace seiche
