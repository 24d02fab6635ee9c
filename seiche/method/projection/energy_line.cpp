#include <seiche/method/projection/energy_line.hpp>

#include <algorithm>

namespace seiche {
namespace {

constexpr double same_sizes = 0.01;  // up to here the sizes of the terms of H are those at z

// d = z without its linear Casimirs, or where S changes with z without the means that solutions keep; false: S has no
// Casimirs.
bool without_casimirs(const System& system, const PhiEvaluator& phi, const Vector& z, Vector& d) {
  return system.structure ? system.structure->without_means(z, d) : phi.without_casimirs(z, d);
}

}  // namespace

EnergyLineScratch::EnergyLineScratch(const System& system)
    : V(static_cast<std::size_t>(system.potential->degree()) + 1) {
  for (Vector* v : {&d, &gradient, &trial}) v->setZero(system.space->size());
}

EnergyLine::EnergyLine(const System& system, const PhiEvaluator& phi, EnergyLineScratch& scratch, const Vector& z,
                       Direction direction, const std::optional<Known>& known)
    : system_(system),
      scratch_(scratch),
      z_(z),
      is_ray_(direction == Direction::ray ||
              (direction == Direction::casimir_free && !without_casimirs(system, phi, z, scratch.d))),
      polynomial_(system.potential->degree() > 0) {
  if (is_ray_)
    prepare_ray(known);
  else if (direction == Direction::steepest)
    turn_downhill(phi);
}

void EnergyLine::prepare_ray(const std::optional<Known>& known) {
  if (!polynomial_) {  // slope() takes the gradient, when it is called
    scratch_.d = z_;
    return;
  }
  K_ = known ? known->K : system_.linear->quadratic(z_);
  slope_ = Slope{2 * K_.value, std::abs(2 * K_.value)};
  if (const int degree = system_.potential->homogeneity(); known && degree > 0) {
    std::fill(scratch_.V.begin(), scratch_.V.end(), 0.0);
    scratch_.V[static_cast<std::size_t>(degree)] = known->V;
  } else {
    system_.potential->along_ray(z_, scratch_.V);
  }
  for (std::size_t k = 1; k < scratch_.V.size(); ++k) {
    slope_->value += static_cast<double>(k) * scratch_.V[k];
    slope_->size += static_cast<double>(k) * std::abs(scratch_.V[k]);
  }
}

void EnergyLine::take_gradients() {
  scratch_.gradient.setZero();
  system_.potential->gradient(z_, scratch_.gradient);
  system_.linear->apply_M(z_, scratch_.trial);
}

void EnergyLine::turn_downhill(const PhiEvaluator& phi) {
  take_gradients();
  scratch_.trial += scratch_.gradient;  // ∇H
  if (!without_casimirs(system_, phi, scratch_.trial, scratch_.d)) scratch_.d = scratch_.trial;
  const double length = system_.space->norm(scratch_.d);
  if (length > 0) scratch_.d *= system_.space->norm(z_) / length;
}

EnergyLine::Slope EnergyLine::slope() {
  if (slope_) return *slope_;
  take_gradients();
  const double of_K = system_.space->dot(scratch_.d, scratch_.trial);
  const double of_V = system_.space->dot(scratch_.d, scratch_.gradient);
  slope_ = Slope{of_K + of_V, std::abs(of_K) + std::abs(of_V)};
  return *slope_;
}

EnergyLine::Parts EnergyLine::at(double lambda) {
  Parts parts{.lambda = lambda};
  if (is_ray_ && polynomial_) {
    const double x = 1 + lambda;
    parts.K = K_.value * x * x;
    for (std::size_t k = scratch_.V.size(); k-- > 0;) {
      parts.V = parts.V * x + scratch_.V[k];
      parts.size = parts.size * std::abs(x) + std::abs(scratch_.V[k]);
    }
    parts.size += K_.magnitude * x * x;
    return parts;
  }
  if (is_ray_)
    scratch_.trial = (1 + lambda) * z_;
  else if (lambda != 0)
    scratch_.trial = z_ + lambda * scratch_.d;
  const Vector& at = lambda == 0 ? z_ : scratch_.trial;
  if (std::abs(lambda) < same_sizes && size_) {
    parts.K = system_.linear->quadratic_energy(at);
    parts.V = system_.potential->value(at);
    parts.size = *size_;
    return parts;
  }
  const ValueAndMagnitude K = system_.linear->quadratic(at);
  const ValueAndMagnitude V = system_.potential->value_and_magnitude(at);
  parts.K = K.value;
  parts.V = V.value;
  parts.size = K.magnitude + V.magnitude;  // and not |K| + |V|, in which terms may cancel
  if (lambda == 0) size_ = parts.size;
  return parts;
}

void EnergyLine::move(Vector& z, double lambda) const {
  if (is_ray_)
    z *= 1 + lambda;
  else
    z += lambda * scratch_.d;
}

}  // namespace seiche
