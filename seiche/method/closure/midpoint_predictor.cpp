#include <seiche/method/closure/midpoint_predictor.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {

void MidpointPredictor::begin(State& s) const {
  s.midpoints = {};
  if (kind_ == Predictor::gradient) return;
  s.midpoints.gradients.assign(MidpointMemory::depth, Vector::Zero(s.z.size()));
  s.midpoints.lengths.assign(MidpointMemory::depth, 0.0);
}

void MidpointPredictor::predict(const State& s, const Propagator& propagator, double h, Vector& z_mid,
                                Propagator::FieldFactors before) {
  has_missed_ = discards_ = false;
  if (kind_ == Predictor::remembered && recall(s, propagator, h, z_mid, before)) return;
  system_.potential->gradient(s.z, z_mid);
  propagator.predict(s.z, z_mid, z_mid, before);
}

bool MidpointPredictor::recall(const State& s, const Propagator& propagator, double h, Vector& z_mid,
                               Propagator::FieldFactors before) {
  const MidpointMemory& memory = s.midpoints;
  if (memory.known < MidpointMemory::depth || memory.resting > 0) return false;
  const double weight = midpoint_memory::weight(memory.lengths, h);
  if (!midpoint_memory::reaches(weight)) return false;
  const Propagator::Gradients gradients{memory.gradients[0], memory.gradients[1], memory.gradients[2], weight,
                                        midpoint_memory::ratio(memory.lengths)};
  Propagator::Recalled recalled;
  const bool is_fused = propagator.recall(s.z, gradients, z_mid, before, recalled);
  if (!is_fused) recalled = recall_unfused(s, propagator, gradients, h, z_mid, before);
  has_missed_ = !midpoint_memory::predicts_well(recalled.missed, recalled.moved);
  if (has_missed_ && recalled.missed_is_rough) {
    has_missed_ = !midpoint_memory::predicts_well(missed(propagator, gradients), recalled.moved);
    if (!has_missed_ && is_fused) propagator.recall(s.z, gradients, z_mid, before, recalled);  // for `powers`
  }
  return !has_missed_;
}

// |F_{h/2}d|² takes a solve or a product of its own, and mostly it is far too small for that to be needed.
double MidpointPredictor::missed(const Propagator& propagator, const Propagator::Gradients& memory) {
  take_difference(memory);
  propagator.predict(at_rest_, difference_, pushed_);
  return system_.space->squared_norm(of_support(pushed_));
}

// d = g₀ − g₁ − ratio·(g₁ − g₂)
void MidpointPredictor::take_difference(const Propagator::Gradients& memory) {
  if (difference_.size() != memory.g0.size())
    for (Vector* v : {&difference_, &pushed_, &product_, &at_rest_}) v->setZero(memory.g0.size());
  of_support(difference_) =
      of_support(memory.g0) - of_support(memory.g1) - memory.ratio * (of_support(memory.g1) - of_support(memory.g2));
}

// F_t d = tSd + ∫₀ᵗ (t − s)e^{SMs}SMSd ds, with t² instead of t²/2 for Cayley's map. Of both terms it is the part on
// the support that is measured: a bound where e^{SMs} keeps lengths and V depends on all of z, and else an estimate.
Propagator::Recalled MidpointPredictor::recall_unfused(const State& s, const Propagator& propagator,
                                                       const Propagator::Gradients& memory, double h, Vector& z_mid,
                                                       Propagator::FieldFactors before) {
  of_support(z_mid) = of_support(memory.g0) + memory.weight * (of_support(memory.g0) - of_support(memory.g1));
  propagator.predict(s.z, z_mid, z_mid, before);

  const Space& space = *system_.space;
  take_difference(memory);
  pushed_ = s.z;
  multiply_fields(before, pushed_);
  const double moved = space.squared_norm(of_support(z_mid) - of_support(pushed_));
  const double t = std::abs(h) / 2;
  system_.linear->apply_S(difference_, pushed_);
  const double first = t * std::sqrt(space.squared_norm(of_support(pushed_)));
  system_.linear->apply_M(pushed_, product_);
  system_.linear->apply_S(product_, pushed_);
  const double second = t * t * std::sqrt(space.squared_norm(of_support(pushed_)));
  return {.missed = (first + second) * (first + second), .moved = moved, .missed_is_rough = true};
}

void MidpointPredictor::keep(State& s, double h, Vector& g) const {
  if (kind_ != Predictor::remembered) return;
  MidpointMemory& memory = s.midpoints;
  memory.known = discards_ ? 0 : std::min(memory.known + 1, MidpointMemory::depth);
  memory.resting = static_cast<int>(midpoint_memory::resting(memory.resting, has_missed_));
  for (std::size_t i = MidpointMemory::depth; --i > 0;) {  // by one, the oldest to the front
    memory.gradients[i].swap(memory.gradients[i - 1]);
    memory.lengths[i] = memory.lengths[i - 1];
  }
  memory.gradients.front().swap(g);
  memory.lengths.front() = h;
}

}  // namespace seiche
