#include <seiche/method/projection/damping_strength.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {

double DampingStrength::largest(double t, double h, const Vector& before, const Vector& after) {
  return system_.damping->largest_rate(*system_.space, t, h, before, after) + std::max(of_S(h, before), of_S(h, after));
}

// |w(z + hw) − w(z)| / (h|w|) with w = sym(S)∇H: how much a step along w alone changes w. For a damped momentum that is
// its γ, whatever the frequencies beside it.
double DampingStrength::of_S(double h, const Vector& z) {
  if (S_is_skew_) return 0;
  if (flow_.size() == 0) {
    for (Vector* v : {&gradient_, &slope_, &flow_, &moved_}) v->setZero(z.size());
    S_is_skew_ = !system_.linear->apply_symmetric_S(z, flow_);
    if (S_is_skew_) return 0;
  }
  take_flow(z, flow_);
  const double length = h * system_.space->norm(flow_);
  if (length == 0) return 0;
  moved_ = z + h * flow_;
  take_flow(moved_, moved_);
  moved_ -= flow_;
  const double rate = system_.space->norm(moved_) / length;
  return std::isfinite(rate) ? rate : std::numeric_limits<double>::infinity();
}

void DampingStrength::take_flow(const Vector& z, Vector& flow) {
  slope_.setZero();
  system_.potential->gradient(z, slope_);
  system_.linear->apply_M(z, gradient_);
  gradient_ += slope_;
  system_.linear->apply_symmetric_S(gradient_, flow);
}

}  // namespace seiche
