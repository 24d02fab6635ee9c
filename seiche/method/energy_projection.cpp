#include <seiche/method/energy_projection.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace seiche {

constexpr int max_secants = 8;
constexpr double max_lambda = 0.9;
constexpr int max_bisections = 60;
constexpr double least_slope = 0.05;  // relative to its terms: below, H hardly changes along the line

// λ ↦ H(z + λd). On the ray d = z it is written in powers of 1 + λ.
class EnergyProjection::Line {
 public:
  Line(EnergyProjection& owner, const Vector& z, bool towards_zero)
      : own_(owner),
        z_(z),
        is_ray_(towards_zero || !owner.phi_.without_casimirs(z, owner.d_)),
        polynomial_(owner.system_.potential->degree() > 0) {
    const LinearPart& linear = *own_.system_.linear;
    const Potential& potential = *own_.system_.potential;
    K_[0] = linear.quadratic_energy(z);
    if (is_ray_) {
      if (polynomial_) potential.along_ray(z, own_.V_along_);
      return;
    }
    linear.apply_M(own_.d_, own_.Md_);
    K_[1] = z.dot(own_.Md_);
    K_[2] = own_.d_.dot(own_.Md_) / 2;
    if (polynomial_) potential.along(z, own_.d_, own_.V_along_);
  }

  Parts at(double lambda) const {
    Parts parts;
    const double x = is_ray_ ? 1 + lambda : lambda;
    parts.K = is_ray_ ? K_[0] * x * x : K_[0] + lambda * (K_[1] + lambda * K_[2]);  // no cancellation near the origin
    if (polynomial_) {
      for (std::size_t k = own_.V_along_.size(); k-- > 0;) parts.V = parts.V * x + own_.V_along_[k];
    } else {
      own_.trial_ = z_ + lambda * direction();
      parts.V = own_.system_.potential->value(own_.trial_);
    }
    return parts;
  }

  struct Slope {
    double value = 0, size = 0;  // size: the sum of its terms without their signs
  };
  // dH/dλ at 0, or its part from ½zᵀMz where the other would cost a gradient
  Slope slope() const {
    const double of_K = is_ray_ ? 2 * K_[0] : K_[1];
    double of_V = 0;
    for (std::size_t k = 1; polynomial_ && k < own_.V_along_.size(); ++k)
      if (is_ray_ || k == 1) of_V += static_cast<double>(k) * own_.V_along_[k];
    return {of_K + of_V, std::abs(of_K) + std::abs(of_V)};
  }

  void move(Vector& z, double lambda) const {  // z is the vector of the line
    if (is_ray_)
      z *= 1 + lambda;
    else
      z += lambda * own_.d_;
  }

 private:
  const Vector& direction() const { return is_ray_ ? z_ : own_.d_; }

  EnergyProjection& own_;
  const Vector& z_;
  bool is_ray_, polynomial_;
  std::array<double, 3> K_{};
};

EnergyProjection::EnergyProjection(const System& system, const PhiEvaluator& phi)
    : system_(system),
      phi_(phi),
      rest_(system.potential->value(Vector::Zero(system.space->size()))),
      V_along_(static_cast<std::size_t>(system.potential->degree()) + 1) {
  for (Vector* v : {&d_, &Md_, &trial_}) v->setZero(system.space->size());
}

EnergyProjection::Outcome EnergyProjection::project(Vector& z, double target, double cap) {
  Outcome outcome;
  const Line line(*this, z, false);
  Parts here = line.at(0);
  const Parts start = here;
  const auto hits = [&](const Parts& p) { return std::abs(p.H() - target) <= p.round_off(); };
  double lambda = 0;
  if (!hits(here)) {
    const Line::Slope slope = line.slope();
    if (std::abs(slope.value) < least_slope * slope.size && start.H() <= cap)
      return {.admissible = true, .H = start.H()};
    double previous = 0;
    double previous_H = start.H();
    lambda = (target - start.H()) / slope.value;
    while (outcome.iterations < max_secants && std::isfinite(lambda) && std::abs(lambda) < max_lambda) {
      here = line.at(lambda);
      ++outcome.iterations;
      if (hits(here)) break;
      const double H = here.H();
      const double next = lambda + (target - H) * (lambda - previous) / (H - previous_H);
      previous = lambda;
      previous_H = H;
      lambda = next;
    }
  }
  if (hits(here) && std::abs(lambda) < max_lambda) {
    if (lambda != 0) line.move(z, lambda);
    outcome.admissible = here.H() <= cap + here.round_off();
    outcome.H = here.H();
    outcome.H_is_target = true;
    return outcome;
  }
  if (start.H() <= cap + start.round_off()) {  // below what it should be, and nothing above it found: safe all the same
    outcome = {.admissible = true, .by_bisection = true, .iterations = outcome.iterations, .H = start.H()};
    return outcome;
  }

  // H falls from H(z) > goal to H(Πz) or H(0) ≤ goal: there is a root between (intermediate value theorem).
  outcome.by_bisection = true;
  const double goal = rest_ <= cap ? std::max(target, rest_) : target;
  for (const bool towards_zero : {false, true}) {
    const Line ray(*this, z, towards_zero);
    double low = -1;
    double high = 0;
    Parts lowest = ray.at(low);
    if (!(lowest.H() <= goal)) continue;
    for (int i = 0; i < max_bisections; ++i) {
      const double middle = (low + high) / 2;
      const Parts parts = ray.at(middle);
      ++outcome.iterations;
      if (parts.H() <= goal) {
        low = middle;
        lowest = parts;
      } else {
        high = middle;
      }
    }
    ray.move(z, low);
    outcome.admissible = true;
    outcome.H = lowest.H();
    return outcome;
  }
  return outcome;
}

}  // namespace seiche
