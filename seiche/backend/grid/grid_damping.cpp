#include <seiche/backend/grid/grid_damping.hpp>
#include <seiche/backend/grid/segment.hpp>
#include <seiche/core/commuting_damping.hpp>
#include <seiche/core/numerics/end_extrapolation.hpp>
#include <seiche/core/simd/add_scaled.hpp>
#include <seiche/core/spectral_radius.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {

GridDamping::GridDamping(const Problem& problem, std::shared_ptr<const FieldTransform> transform,
                         std::unique_ptr<LinearMap> constant, MakeFlow make_flow)
    : slots_(transform->slots()),
      constant_(std::move(constant)),
      make_flow_(std::move(make_flow)),
      rate_(problem.damping.rate),
      rate_of_D0_(seiche::rate_of_D0(problem)),
      rate_fields_(problem.damping.rate_fields),
      touches_potential_(problem.damping_moves_potential()),
      rates_commute_(!problem.damping.field_rate && rate_commutes(problem)),
      flows_(cached_step_sizes(problem.size())),
      scratch_(constant_ || problem.damping.field_rate ? problem.field_count() * slots_ : 0) {
  if (problem.damping.field_rate)
    field_rate_ = std::make_unique<FieldDecay>(problem.damping.field_rate, std::move(transform));
}

double GridDamping::rate_decay(double t, double h) const {
  if (!rate_->is_constant()) return std::exp(-rate_->integral(t, h));
  if (decay_of_.h != h) decay_of_ = {h, std::exp(-rate_->integral(t, h))};
  return decay_of_.decay;
}

void GridDamping::constant_flow(double h, Vector& z) const {
  flows_.at(h, [&] { return make_flow_(h); }).apply(z, scratch_);
  z.swap(scratch_);
}

void GridDamping::flow(double t, double h, Vector& z) const {
  if (constant_) constant_flow(rates_commute_ ? h : h / 2, z);
  rates_flow(t, h, z);
  if (constant_ && !rates_commute_) constant_flow(h / 2, z);
}

void GridDamping::rates_flow(double t, double h, Vector& z) const {
  if (rate_) {
    const double decay = rate_decay(t, h);
    for (std::size_t f = 0; f < rate_fields_.size(); ++f)
      if (rate_fields_[f]) z.segment(static_cast<Index>(f) * slots_, slots_) *= decay;
  }
  if (!field_rate_) return;
  const Vector& decay = field_rate_->factors(t, h);
  for (std::size_t f = 0; f < rate_fields_.size(); ++f)
    if (rate_fields_[f]) field_rate_->multiply(decay, segment(z, static_cast<Index>(f) * slots_, slots_));
}

bool GridDamping::field_factors(double t, double h, std::span<double> factors) const {
  if (constant_ || field_rate_) return false;
  const double decay = rate_ ? rate_decay(t, h) : 1.0;
  for (std::size_t f = 0; f < factors.size(); ++f) factors[f] = rate_ && rate_fields_[f] ? decay : 1.0;
  return true;
}

std::optional<double> GridDamping::factor_of_identity(double t) const {
  if (constant_ || field_rate_ || !rate_) return std::nullopt;
  if (std::find(rate_fields_.begin(), rate_fields_.end(), false) != rate_fields_.end()) return std::nullopt;
  return rate_->value(t);
}

double GridDamping::largest_factor(const Space& space, double t) const {
  const double uniform = rate_ ? std::abs(rate_->value(t)) : 0.0;
  return field_rate_ ? uniform + space.max_norm(field_rate_->values(t)) : uniform;
}

double GridDamping::largest_rate(const Space& space, double t, double h, const Vector&, const Vector&) const {
  if (!rate_of_constant_) {
    rate_of_constant_ = 0;
    if (constant_)
      rate_of_constant_ = spectral_radius(space, [this](Vector& z) {
        constant_->apply(z, scratch_);
        z.swap(scratch_);
      });
    if (is_constant()) *rate_of_constant_ += largest_factor(space, t);
  }
  if (is_constant()) return *rate_of_constant_;
  const double of_ends = std::max(largest_factor(space, t), largest_factor(space, t + h));
  return *rate_of_constant_ + std::max(of_ends, largest_factor(space, t + h / 2));
}

void GridDamping::apply_constant(const Vector& z, Vector& out) const {
  if (constant_) {
    constant_->apply(z, out);
  } else {
    out.setZero();
  }
}

void GridDamping::apply_D0(const Vector& z, Vector& out) const {
  apply_constant(z, out);
  for (std::size_t f = 0; f < rate_fields_.size(); ++f) {
    const Index begin = static_cast<Index>(f) * slots_;
    if (rate_fields_[f]) out.segment(begin, slots_) += rate_of_D0_ * z.segment(begin, slots_);
  }
}

void GridDamping::apply(double t, const Vector& z, Vector& out) const {
  apply_constant(z, out);
  add_rates(rate_ ? rate_->value(t) : 0.0, field_rate_ ? &field_rate_->values(t) : nullptr, z, out);
}

void GridDamping::apply_rest(double t, const Vector& z, Vector& out) const {
  out.setZero();
  if (is_constant()) return;
  add_rates((rate_ ? rate_->value(t) : 0.0) - rate_of_D0_, field_rate_ ? &field_rate_->values(t) : nullptr, z, out);
}

double GridDamping::integral_error_at_ends(double t, double h) const {
  const EndExtrapolation& ends = end_extrapolation();
  double begin = rate_->value(t), end = rate_->value(t + h);
  for (std::size_t i = 0; i < EndExtrapolation::count; ++i) {
    const double gamma = rate_->value(t + ends.points[i] * h);
    begin -= ends.to_begin[i] * gamma;
    end -= ends.to_end[i] * gamma;
  }
  return EndExtrapolation::width * (std::abs(begin) + std::abs(end));
}

void GridDamping::add_quadrature_error(const Space& /*space*/, double t, double h, std::span<const double> c,
                                       std::span<const double> w, const Vector& /*before*/, const Vector& after,
                                       Vector& out) const {
  if (is_constant()) return;
  double missed = rate_ ? rate_->integral(t, h) : 0.0;
  for (std::size_t i = 0; rate_ && i < c.size(); ++i) missed -= h * w[i] * rate_->value(t + c[i] * h);
  if (rate_) missed += std::copysign(h * integral_error_at_ends(t, h), missed);
  const bool varies = field_rate_ && !field_rate_->is_constant();
  if (varies) {
    missed_ = field_rate_->integrals(t, h);
    for (std::size_t i = 0; i < c.size(); ++i) missed_ -= h * w[i] * field_rate_->values(t + c[i] * h);
  }
  add_rates(missed, varies ? &missed_ : nullptr, after, out);
}

void GridDamping::add_rates(double gamma, const Vector* at_points, const Vector& z, Vector& out) const {
  for (std::size_t f = 0; f < rate_fields_.size(); ++f) {
    const Index begin = static_cast<Index>(f) * slots_;
    if (!rate_fields_[f]) continue;
    add_scaled(out.data() + begin, gamma, z.data() + begin, slots_, out.data() + begin);
    if (at_points == nullptr) continue;
    scratch_.head(slots_) = z.segment(begin, slots_);
    field_rate_->multiply(*at_points, segment(scratch_, 0, slots_));
    out.segment(begin, slots_) += scratch_.head(slots_);
  }
}

}  // namespace seiche
