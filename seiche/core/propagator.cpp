#include <seiche/core/linear_part.hpp>
#include <seiche/core/propagator.hpp>
#include <seiche/core/space.hpp>

namespace seiche {

void multiply_fields(Propagator::FieldFactors factors, Vector& z) {
  const Index fields = static_cast<Index>(factors.size());
  const Index slots = fields > 0 ? z.size() / fields : 0;
  for (Index f = 0; f < fields; ++f)
    if (factors[static_cast<std::size_t>(f)] != 1) z.segment(f * slots, slots) *= factors[static_cast<std::size_t>(f)];
}

Propagator::Powers PlainPropagator::powers(const Vector& z, const Vector& f, FieldFactors before) const {
  z_ = z;
  multiply_fields(before, z_);
  dz_.resize(z.size());
  q_.resize(z.size());
  increment(z_, dz_);
  force(f, q_);
  return {space_.dot(f, dz_), space_.dot(f, q_), linear_.quadratic_energy(z_)};
}

void PlainPropagator::update(Vector& z, const Vector&, double c, FieldFactors, FieldFactors after) const {
  z = z_ + dz_ + c * q_;
  multiply_fields(after, z);
}

Propagators::Propagators(const LinearPart& linear, PropagatorKind kind, std::size_t capacity)
    : linear_(linear), kind_(kind), cache_(capacity) {}

const Propagator& Propagators::at(double h) {
  return cache_.at(h, [&] { return linear_.propagator(kind_, h); });
}

}  // namespace seiche
