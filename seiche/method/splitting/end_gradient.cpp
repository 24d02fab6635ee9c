#include <seiche/method/splitting/end_gradient.hpp>

#include <cmath>

namespace seiche {

EndGradient::EndGradient(const System& system) : system_(system) {
  for (Vector* v : {&start_, &gradient_}) v->setZero(system.space->size());
}

void EndGradient::begin(State& s) const {
  if (s.history.size() != 1) s.history.assign(1, Vector::Zero(s.z.size()));
  s.history_h = 0;
}

const Vector& EndGradient::at_start(const State& s) {
  if (s.history_h != 0) return s.history.front();
  system_.potential->gradient(s.z, start_);
  return start_;
}

const Vector& EndGradient::take(const Vector& z) {
  V_ = system_.potential->value_and_gradient(z, gradient_);
  return gradient_;
}

//   ∇V(xz) = xᵈ⁻¹∇V(z) where V is homogeneous of degree d
void EndGradient::accept(State& s, double h, double factor) {
  const int degree = system_.potential->homogeneity();
  const bool is_known = factor == 1 || (factor != 0 && degree > 0);
  if (is_known && factor != 1) gradient_ *= std::pow(factor, degree - 1);
  s.history.front().swap(gradient_);
  s.history_h = is_known ? h : 0;
}

}  // namespace seiche
