#include <seiche/method/common/nonlinear_force.hpp>

namespace seiche {

PhiRows::Forces NonlinearForce::kind_of(const System& system) {
  return system.damping->is_constant() && !system.force && !system.structure ? PhiRows::Forces::gradients
                                                                             : PhiRows::Forces::states;
}

NonlinearForce::NonlinearForce(const System& system) : NonlinearForce(system, kind_of(system)) {}

NonlinearForce::NonlinearForce(const System& system, PhiRows::Forces kind)
    : system_(system), kind_(kind), gradient_(Vector::Zero(system.space->size())), rest_(gradient_) {
  if (system.structure) gradient_H_ = turned_ = gradient_;
}

double NonlinearForce::evaluate(double t, Vector& z) {
  if (kind_ == PhiRows::Forces::gradients) return system_.potential->value_and_gradient(z, z);
  const double V = system_.potential->value_and_gradient(z, gradient_);
  complete(t, z);
  return V;
}

void NonlinearForce::evaluate(double t, Vector& z, Look look) {
  system_.potential->gradient(z, gradient_);
  look(z, gradient_);
  complete(t, z);
}

double NonlinearForce::external(double t) {
  if (!system_.force) return 0;
  rest_.setZero();
  system_.force->add(t, 1, rest_);
  return system_.space->norm(rest_);
}

void NonlinearForce::complete(double t, Vector& z) {
  if (kind_ == PhiRows::Forces::gradients) {
    const Potential::Support support = system_.potential->support();
    z.segment(support.begin, support.size) = gradient_.segment(support.begin, support.size);
    return;
  }
  system_.damping->apply_rest(t, z, rest_);
  if (system_.force) system_.force->add(t, -1, rest_);
  if (system_.structure) {
    system_.linear->apply_M(z, gradient_H_);
    gradient_H_ += gradient_;
    system_.structure->apply(z, gradient_H_, turned_);
    rest_ -= turned_;
  }
  system_.linear->apply_S(gradient_, z);
  z -= rest_;
}

}  // namespace seiche
