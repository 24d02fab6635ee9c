#include <seiche/core/system.hpp>

namespace seiche {

double System::energy_round_off(const Vector& z) const {
  return 50 * epsilon * (2 * linear->quadratic_magnitude(z) + potential->magnitude(z));
}

void System::gradient(const Vector& z, Vector& out) const {
  Vector nonlinear(z.size());
  potential->gradient(z, nonlinear);
  linear->apply_M(z, out);
  out += nonlinear;
}

void System::right_hand_side(double t, const Vector& z, Vector& out) const {
  Vector gradient_H(z.size());
  gradient(z, gradient_H);
  linear->apply_S(gradient_H, out);
  damping->apply(t, z, gradient_H);
  out -= gradient_H;
}

}  // namespace seiche
