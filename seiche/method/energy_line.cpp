#include <seiche/method/energy_line.hpp>

#include <cmath>

namespace seiche {

EnergyLineScratch::EnergyLineScratch(const System& system)
    : V(static_cast<std::size_t>(system.potential->degree()) + 1) {
  for (Vector* v : {&d, &Md, &trial}) v->setZero(system.space->size());
}

EnergyLine::EnergyLine(const System& system, const PhiEvaluator& phi, EnergyLineScratch& scratch, const Vector& z,
                       Direction direction)
    : system_(system),
      scratch_(scratch),
      z_(z),
      is_ray_(direction == Direction::ray ||
              (direction == Direction::casimir_free && !phi.without_casimirs(z, scratch.d))),
      polynomial_(system.potential->degree() > 0) {
  const LinearPart& linear = *system_.linear;
  const Potential& potential = *system_.potential;
  K_[0] = linear.quadratic_energy(z);
  if (is_ray_) {
    if (polynomial_) potential.along_ray(z, scratch_.V);
    return;
  }
  if (direction == Direction::steepest) {
    scratch_.trial.setZero();
    potential.gradient(z, scratch_.trial);
    linear.apply_M(z, scratch_.Md);
    scratch_.trial += scratch_.Md;
    if (!phi.without_casimirs(scratch_.trial, scratch_.d)) scratch_.d = scratch_.trial;
    const double length = scratch_.d.norm();
    if (length > 0) scratch_.d *= z.norm() / length;
  }
  linear.apply_M(scratch_.d, scratch_.Md);
  K_[1] = z.dot(scratch_.Md);
  K_[2] = scratch_.d.dot(scratch_.Md) / 2;
  if (polynomial_) potential.along(z, scratch_.d, scratch_.V);
}

EnergyLine::Parts EnergyLine::at(double lambda) const {
  Parts parts;
  const double x = is_ray_ ? 1 + lambda : lambda;
  parts.K = is_ray_ ? K_[0] * x * x : K_[0] + lambda * (K_[1] + lambda * K_[2]);
  if (polynomial_) {
    for (std::size_t k = scratch_.V.size(); k-- > 0;) {
      parts.V = parts.V * x + scratch_.V[k];
      parts.size = parts.size * std::abs(x) + std::abs(scratch_.V[k]);
    }
  } else {
    scratch_.trial = z_ + lambda * direction();
    parts.V = system_.potential->value(scratch_.trial);
    parts.size = std::abs(parts.V);
  }
  return parts;
}

EnergyLine::Slope EnergyLine::slope() const {
  const double of_K = is_ray_ ? 2 * K_[0] : K_[1];
  double of_V = 0;
  double size = std::abs(of_K);
  for (std::size_t k = 1; polynomial_ && k < scratch_.V.size(); ++k) {
    if (!is_ray_ && k > 1) break;
    of_V += static_cast<double>(k) * scratch_.V[k];
    size += static_cast<double>(k) * std::abs(scratch_.V[k]);
  }
  return {of_K + of_V, size};
}

void EnergyLine::move(Vector& z, double lambda) const {
  if (is_ray_)
    z *= 1 + lambda;
  else
    z += lambda * scratch_.d;
}

}  // namespace seiche
