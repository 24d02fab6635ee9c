#include <seiche/backend/grid/field_decay.hpp>
#include <seiche/backend/grid/segment.hpp>

namespace seiche {

FieldDecay::FieldDecay(FieldRatePointer rate, std::shared_ptr<const FieldTransform> transform)
    : rate_(std::move(rate)),
      transform_(std::move(transform)),
      constant_(cached_step_sizes(transform_->unknowns())),
      current_(transform_->unknowns()),
      physical_(transform_->unknowns()) {}

void FieldDecay::set_factors(double t, double h, Vector& factors) const {
  rate_->integrals(t, h, all(factors));
  factors = (-factors.array()).exp();
}

const Vector& FieldDecay::factors(double t, double h) const {
  if (!rate_->is_constant()) {
    set_factors(t, h, current_);
    return current_;
  }
  return constant_.at(h, [&] {
    auto made = std::make_unique<Vector>(transform_->unknowns());
    set_factors(t, h, *made);
    return made;
  });
}

const Vector& FieldDecay::integrals(double t, double h) const {
  rate_->integrals(t, h, all(current_));
  return current_;
}

const Vector& FieldDecay::values(double t) const {
  rate_->values(t, all(current_));
  return current_;
}

void FieldDecay::multiply(const Vector& factors, std::span<double> slots) const {
  transform_->inverse(slots, all(physical_));
  physical_.array() *= factors.array();
  transform_->forward(all(physical_), slots);
}

}  // namespace seiche
