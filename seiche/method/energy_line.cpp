#include <seiche/method/energy_line.hpp>

namespace seiche {
namespace {

// d = z without its linear Casimirs, or where S changes with z without the means that solutions keep; false: there are none.
bool without_casimirs(const System& system, const PhiEvaluator& phi, const Vector& z, Vector& d) {
  return system.structure ? system.structure->without_means(z, d) : phi.without_casimirs(z, d);
}

}  // namespace

EnergyLineScratch::EnergyLineScratch(const System& system)
    : V(static_cast<std::size_t>(system.potential->degree()) + 1) {
  for (Vector* v : {&d, &gradient, &trial}) v->setZero(system.space->size());
}

EnergyLine::EnergyLine(const System& system, const PhiEvaluator& phi, EnergyLineScratch& scratch, const Vector& z,
                       Direction direction)
    : system_(system),
      scratch_(scratch),
      z_(z),
      is_ray_(direction == Direction::ray ||
              (direction == Direction::casimir_free && !without_casimirs(system, phi, z, scratch.d))),
      polynomial_(system.potential->degree() > 0) {
  if (is_ray_)
    prepare_ray();
  else
    prepare_line(phi, direction);
}

void EnergyLine::prepare_ray() {
  K_ = system_.linear->quadratic_energy(z_);
  slope_ = {2 * K_, std::abs(2 * K_)};
  if (!polynomial_) return;
  system_.potential->along_ray(z_, scratch_.V);
  for (std::size_t k = 1; k < scratch_.V.size(); ++k) {
    slope_.value += static_cast<double>(k) * scratch_.V[k];
    slope_.size += static_cast<double>(k) * std::abs(scratch_.V[k]);
  }
}

void EnergyLine::prepare_line(const PhiEvaluator& phi, Direction direction) {
  scratch_.gradient.setZero();
  system_.potential->gradient(z_, scratch_.gradient);
  system_.linear->apply_M(z_, scratch_.trial);
  if (direction == Direction::steepest) {
    scratch_.trial += scratch_.gradient;  // ∇H, for a moment
    if (!without_casimirs(system_, phi, scratch_.trial, scratch_.d)) scratch_.d = scratch_.trial;
    const double length = scratch_.d.norm();
    if (length > 0) scratch_.d *= z_.norm() / length;
    scratch_.trial -= scratch_.gradient;
  }
  const double of_K = scratch_.d.dot(scratch_.trial);
  const double of_V = scratch_.d.dot(scratch_.gradient);
  slope_ = {of_K + of_V, std::abs(of_K) + std::abs(of_V)};
}

EnergyLine::Parts EnergyLine::at(double lambda) const {
  Parts parts{.lambda = lambda};
  if (is_ray_ && polynomial_) {
    const double x = 1 + lambda;
    parts.K = K_ * x * x;
    for (std::size_t k = scratch_.V.size(); k-- > 0;) {
      parts.V = parts.V * x + scratch_.V[k];
      parts.size = parts.size * std::abs(x) + std::abs(scratch_.V[k]);
    }
    return parts;
  }
  if (is_ray_)
    scratch_.trial = (1 + lambda) * z_;
  else
    scratch_.trial = z_ + lambda * scratch_.d;
  parts.K = system_.linear->quadratic_energy(scratch_.trial);
  parts.V = system_.potential->value(scratch_.trial);
  parts.size = std::abs(parts.V);
  return parts;
}

void EnergyLine::move(Vector& z, double lambda) const {
  if (is_ray_)
    z *= 1 + lambda;
  else
    z += lambda * scratch_.d;
}

}  // namespace seiche
