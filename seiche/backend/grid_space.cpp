#include <seiche/backend/grid_space.hpp>

#include <algorithm>

namespace seiche {
namespace {

std::span<const double> segment(const Vector& v, Index begin, Index size) {
  return {v.data() + begin, static_cast<std::size_t>(size)};
}

std::span<double> segment(Vector& v, Index begin, Index size) {
  return {v.data() + begin, static_cast<std::size_t>(size)};
}

std::span<double> all(Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

}  // namespace

GridSpace::GridSpace(Index fields, std::shared_ptr<const FieldTransform> transform)
    : fields_(fields), transform_(std::move(transform)) {}

void GridSpace::to_physical(const Vector& z, Vector& values) const {
  const Index n = transform_->unknowns();
  const Index slots = transform_->slots();
  for (Index f = 0; f < fields_; ++f) transform_->inverse(segment(z, f * slots, slots), segment(values, f * n, n));
}

void GridSpace::from_physical(const Vector& values, Vector& z) const {
  const Index n = transform_->unknowns();
  const Index slots = transform_->slots();
  for (Index f = 0; f < fields_; ++f) transform_->forward(segment(values, f * n, n), segment(z, f * slots, slots));
}

GridPotential::GridPotential(const Problem& problem, std::shared_ptr<const FieldTransform> transform)
    : pointwise_(problem.potential), transform_(std::move(transform)) {
  const Index slots = transform_->slots();
  support_ = {problem.potential_field * slots, pointwise_ ? slots : 0};
  for (Vector* scratch : {&a_, &b_, &slope_}) scratch->setZero(transform_->unknowns());
}

std::span<const double> GridPotential::values_of(const Vector& z, Vector& values) const {
  transform_->inverse(segment(z, support_.begin, support_.size), all(values));
  return all(values);
}

void GridPotential::set_gradient(const Vector& physical, Vector& gradient) const {
  gradient.head(support_.begin).setZero();
  gradient.tail(gradient.size() - support_.begin - support_.size).setZero();
  transform_->forward(segment(physical, 0, physical.size()), segment(gradient, support_.begin, support_.size));
}

double GridPotential::value(const Vector& z) const {
  if (!pointwise_) return 0;
  ++counts_.values;
  return pointwise_->value(values_of(z, a_));
}

double GridPotential::magnitude(const Vector& z) const {
  return pointwise_ ? pointwise_->magnitude(values_of(z, a_)) : 0;
}

double GridPotential::value_and_gradient(const Vector& z, Vector& gradient) const {
  if (!pointwise_) {
    gradient.setZero();
    return 0;
  }
  ++counts_.gradients;
  const double v = pointwise_->value_and_gradient(values_of(z, a_), all(slope_));
  set_gradient(slope_, gradient);
  return v;
}

void GridPotential::mean_gradient(const Vector& a, const Vector& b, Vector& mean) const {
  if (!pointwise_) {
    mean.setZero();
    return;
  }
  ++counts_.gradients;
  pointwise_->mean_gradient(values_of(a, a_), values_of(b, b_), all(slope_));
  set_gradient(slope_, mean);
}

void GridPotential::along(const Vector& p, const Vector& q, std::span<double> coefficients) const {
  if (!pointwise_) {
    std::fill(coefficients.begin(), coefficients.end(), 0.0);
    return;
  }
  ++counts_.values;
  pointwise_->along(values_of(p, a_), values_of(q, b_), coefficients);
}

GridDamping::GridDamping(const Problem& problem, Index slots, std::unique_ptr<LinearMap> constant, MakeFlow make_flow)
    : slots_(slots),
      constant_(std::move(constant)),
      make_flow_(std::move(make_flow)),
      rate_(problem.damping.rate),
      rate_fields_(problem.damping.rate_fields),
      touches_potential_(problem.potential && problem.damping.moves(problem.potential_field)),
      scratch_(problem.field_count() * slots) {}

const LinearMap& GridDamping::flow_map(double h) const {
  const auto found = std::find_if(flows_.begin(), flows_.end(), [h](const CachedFlow& c) { return c.h == h; });
  if (found == flows_.end()) {
    constexpr std::size_t capacity = 16;
    if (flows_.size() == capacity) flows_.pop_back();
    flows_.insert(flows_.begin(), CachedFlow{h, make_flow_(h)});
  } else {
    std::rotate(flows_.begin(), found, found + 1);
  }
  return *flows_.front().map;
}

void GridDamping::flow(double t, double h, Vector& z) const {
  if (rate_) {
    const double decay = std::exp(-rate_->integral(t, h));
    for (std::size_t f = 0; f < rate_fields_.size(); ++f)
      if (rate_fields_[f]) z.segment(static_cast<Index>(f) * slots_, slots_) *= decay;
  }
  if (constant_) {
    flow_map(h).apply(z, scratch_);
    z.swap(scratch_);
  }
}

void GridDamping::apply(double t, const Vector& z, Vector& out) const {
  if (constant_) {
    constant_->apply(z, out);
  } else {
    out.setZero();
  }
  if (!rate_) return;
  const double gamma = rate_->value(t);
  for (std::size_t f = 0; f < rate_fields_.size(); ++f) {
    const Index begin = static_cast<Index>(f) * slots_;
    if (rate_fields_[f]) out.segment(begin, slots_) += gamma * z.segment(begin, slots_);
  }
}

}  // namespace seiche
