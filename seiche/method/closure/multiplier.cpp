#include <seiche/method/closure/closure.hpp>
#include <seiche/method/closure/multiplier.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {
MultiplierEquation::MultiplierEquation(const Space& space, const Potential& potential)
    : space_(space), potential_(potential), mean_(Vector::Zero(space.size())) {
  if (potential.degree() > 0) {
    coefficients_.resize(static_cast<std::size_t>(std::max(potential.degree(), 2)) + 1);
  } else {
    for (Vector* v : {&end_, &gradient_, &increment_}) v->setZero(space.size());
  }
}

void MultiplierEquation::set(const Line& line, const MeasuredAt* measured_at) {
  left_ = 0;
  const Vector& start = measured_at ? measured_at->start : line.z;
  const Vector& end = measured_at ? measured_at->end : line.z_plus;
  const Vector& direction = measured_at ? measured_at->direction : line.q;

  potential_.mean_gradient(start, end, mean_);     // ḡ(0)
  gap_norm_ = space_.stable_norm(mean_ - line.g);  // squares of what has decayed would underflow
  mean_norm_ = space_.stable_norm(mean_);
  const ValueAndMagnitude gd = space_.dot_and_magnitude(line.g, line.delta),
                          gq = space_.dot_and_magnitude(line.g, line.q),
                          ed = space_.dot_and_magnitude(line.e, line.delta),
                          eq = space_.dot_and_magnitude(line.e, line.q);
  gd_ = gd.value;
  linear_ = gq.value + ed.value;
  eq_ = eq.value;
  const Potential::Support support = potential_.support();
  const double sizes = space_.norm(line.g) * space_.norm(line.delta.segment(support.begin, support.size));
  cosine_ = sizes > 0 ? gd_ / sizes : 0;
  const double work = measured_at ? space_.absolute_dot(mean_, end - start) : space_.absolute_dot(mean_, line.delta);
  scales_ = {work + gd.magnitude, space_.absolute_dot(mean_, direction) + gq.magnitude + ed.magnitude, eq.magnitude};

  delta_ = &line.delta;
  start_ = &start;
  if (coefficients_.empty()) {
    q_ = &line.q;
    g_ = &line.g;
    e_ = &line.e;
    end_0_ = &end;
    direction_ = &direction;
    measured_elsewhere_ = measured_at != nullptr;
    return;
  }
  std::fill(coefficients_.begin(), coefficients_.end(), 0.0);
  potential_.along(end, direction, std::span(coefficients_.data(), static_cast<std::size_t>(potential_.degree()) + 1));
  coefficients_[0] =
      measured_at ? space_.dot(mean_, end - start) - gd_ : space_.dot(mean_ - line.g, line.delta);  // F(0)
  coefficients_[1] -= linear_;
  coefficients_[2] -= eq_;
}

MultiplierEquation::Value MultiplierEquation::at(double x) {
  if (coefficients_.empty()) return at_by_quadrature(x);
  double F = 0;
  double slope = 0;
  for (std::size_t i = coefficients_.size(); i-- > 0;) {
    slope = slope * x + F;
    F = F * x + coefficients_[i];
  }
  return {F + left_, slope, scales_[0] + std::abs(x) * (scales_[1] + std::abs(x) * scales_[2])};
}

// F from the mean gradient and δ itself: end − start would carry the round-off of z, which short steps do not forgive.
MultiplierEquation::Value MultiplierEquation::at_by_quadrature(double x) {
  end_ = *end_0_ + x * *direction_;
  potential_.mean_gradient(*start_, end_, mean_);
  potential_.gradient(end_, gradient_);
  double F = 0;
  if (measured_elsewhere_) {
    F = space_.dot(mean_, end_ - *start_) - (gd_ + x * (linear_ + x * eq_));
  } else {
    increment_ = *delta_ + x * *q_;
    F = space_.dot(mean_ - *g_ - x * *e_, increment_);
  }
  return {F + left_, space_.dot(gradient_, *direction_) - (linear_ + 2 * x * eq_),
          scales_[0] + std::abs(x) * (scales_[1] + std::abs(x) * scales_[2])};
}

double MultiplierEquation::round_off() {
  bound_mean_gradient(potential_, *start_, mean_);
  return space_.absolute_dot(mean_, *delta_);
}

bool MultiplierEquation::gap_is_round_off() {
  bound_mean_gradient(potential_, *start_, mean_);
  return gap_norm_ <= space_.stable_norm(mean_);
}

MultiplierEquation::Root MultiplierEquation::newton(int max_iterations, Stop stop) {
  Root root;
  for (;;) {
    const Value value = at(root.x);
    if (value.is_resolved()) {
      root.converged = true;
      return root;
    }
    if (root.iterations == max_iterations || value.slope == 0 || !std::isfinite(value.F)) {
      root.converged = std::isfinite(value.F) && std::abs(value.F) <= round_off();
      return root;
    }
    const double change = -value.F / value.slope;
    root.x += change;
    ++root.iterations;
    if (stop == Stop::residual_or_update && std::abs(change) <= 4 * epsilon * std::max(1.0, std::abs(1 + root.x))) {
      root.converged = true;
      return root;
    }
  }
}

}  // namespace seiche
