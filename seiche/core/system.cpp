#include <seiche/core/base/error.hpp>
#include <seiche/core/generic_state.hpp>
#include <seiche/core/system.hpp>

namespace seiche {

EnergyTerms System::energy_terms(const Vector& z) const {
  return {.quadratic = linear->quadratic(z), .potential = potential->value_and_magnitude(z)};
}

void System::gradient(const Vector& z, Vector& out) const {
  Vector nonlinear = Vector::Zero(z.size());
  potential->gradient(z, nonlinear);
  linear->apply_M(z, out);
  out += nonlinear;
}

System::Dissipation System::dissipation(double t, const Vector& z, const Vector& potential_gradient, Vector& scratch,
                                        Vector& gradient_H) const {
  linear->apply_M(z, gradient_H);
  gradient_H += potential_gradient;
  damping->apply(t, z, scratch);
  Dissipation result;
  double sizes = 0;
  const auto in_scratch = [&] {
    const ValueAndMagnitude product = space->dot_and_magnitude(gradient_H, scratch);
    sizes += product.magnitude;
    return product.value;
  };
  result.rate = in_scratch();
  linear->apply_S(gradient_H, scratch);  // a skew S too: the sizes of its terms tell what the rate may be off by
  result.rate -= in_scratch();
  if (structure && structure->dissipates()) {
    structure->apply(z, gradient_H, scratch);
    result.rate -= in_scratch();
  }
  if (force) {
    scratch.setZero();
    force->add(t, 1, scratch);
    result.work = in_scratch();
    result.rate -= result.work;
  }
  result.round_off = 100 * epsilon * sizes;
  return result;
}

//   ż = S∇H − D(t)z                                                                                         (1.1)
// and what goes beyond it: S(z), friction, forces.
void System::right_hand_side(double t, const Vector& z, Vector& out) const {
  Vector gradient_H(z.size());
  gradient(z, gradient_H);
  linear->apply_S(gradient_H, out);
  if (structure) {
    Vector more(z.size());
    structure->apply(z, gradient_H, more);
    out += more;
  }
  damping->apply(t, z, gradient_H);
  out -= gradient_H;
  if (force) force->add(t, 1, out);
}

void SparseOptions::validate() const {
  if (pade_degree < 0 || pade_degree > max_pade_degree)
    throw Error("pade_degree = {} must be between 1 and {}, or 0 for whatever round-off asks for", pade_degree,
                max_pade_degree);
  if (lanczos_dimension < 0 || lanczos_dimension == 1)
    throw Error("lanczos_dimension = {} must be at least 2, or 0 for as many as it takes", lanczos_dimension);
}

bool is_skew(const System& system) {
  const Vector z = Vector::Zero(system.space->size());
  Vector image(z);
  return !system.linear->apply_symmetric_S(z, image);
}

bool is_gradient_flow(const System& system) {
  if (is_skew(system)) return false;
  const Vector z = generic_state(*system.space);
  Vector symmetric = Vector::Zero(z.size()), all = symmetric;
  system.linear->apply_symmetric_S(z, symmetric);
  system.linear->apply_S(z, all);
  const double size = system.space->norm(all);
  return size > 0 && system.space->norm(all - symmetric) <= 1e3 * epsilon * size;
}

}  // namespace seiche
