#include <seiche/backend/grid_damping.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {

GridDamping::GridDamping(const Problem& problem, Index slots, std::unique_ptr<LinearMap> constant, MakeFlow make_flow)
    : slots_(slots),
      constant_(std::move(constant)),
      make_flow_(std::move(make_flow)),
      rate_(problem.damping.rate),
      rate_fields_(problem.damping.rate_fields),
      touches_potential_(problem.damping_moves_potential()),
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
