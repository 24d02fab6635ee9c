#include <seiche/backend/grid/friction_damping.hpp>
#include <seiche/backend/grid/segment.hpp>
#include <seiche/core/error.hpp>

namespace seiche {
namespace {

Momenta required_momenta(const Problem& problem) {
  const std::optional<Momenta> found = momenta(problem);
  if (!found)
    throw Error(
        "the friction {} acts on velocities, and {} has none: z = (q, p) with q̇ = wp, S = [[0, I], [−I, 0]] and w times "
        "the identity in M is what it needs",
        problem.friction->text(), problem.name);
  return *found;
}

}  // namespace

FrictionDamping::FrictionDamping(const Problem& problem, std::shared_ptr<const FieldTransform> transform,
                                 std::unique_ptr<Damping> linear)
    : friction_(problem.friction),
      momenta_(required_momenta(problem)),
      transform_(std::move(transform)),
      linear_(std::move(linear)),
      touches_potential_(problem.damping_moves_potential()),
      slots_(transform_->slots()) {
  for (Vector* v : {&q_, &v_, &r_}) v->setZero(momenta_.count * transform_->unknowns());
}

void FrictionDamping::read_points(const Vector& z) const {
  const Index slots = transform_->slots(), points = transform_->unknowns();
  for (Index f = 0; f < momenta_.count; ++f) {
    transform_->inverse(segment(z, (momenta_.first + f) * slots, slots), segment(v_, f * points, points));
    if (friction_->uses_coordinates())
      transform_->inverse(segment(z, f * slots, slots), segment(q_, f * points, points));
  }
  v_ *= momenta_.inverse_mass;
}

void FrictionDamping::flow(double t, double h, Vector& z) const {
  const Index slots = transform_->slots(), points = transform_->unknowns();
  if (!linear_->is_zero()) linear_->flow(t, h / 2, z);
  read_points(z);
  friction_->flow(t, h, momenta_.inverse_mass, all(q_), all(v_));
  v_ /= momenta_.inverse_mass;
  for (Index f = 0; f < momenta_.count; ++f)
    transform_->forward(segment(v_, f * points, points), segment(z, (momenta_.first + f) * slots, slots));
  if (!linear_->is_zero()) linear_->flow(t + h / 2, h / 2, z);
}

void FrictionDamping::add_friction(double t, const Vector& z, Vector& out) const {
  const Index slots = transform_->slots(), points = transform_->unknowns();
  read_points(z);
  friction_->force(t, all(q_), all(v_), all(r_));
  for (Index f = 0; f < momenta_.count; ++f) {
    transform_->forward(segment(r_, f * points, points), all(slots_));
    out.segment((momenta_.first + f) * slots, slots) += slots_;
  }
}

void FrictionDamping::apply(double t, const Vector& z, Vector& out) const {
  linear_->apply(t, z, out);
  add_friction(t, z, out);
}

void FrictionDamping::apply_rest(double t, const Vector& z, Vector& out) const {
  linear_->apply_rest(t, z, out);
  add_friction(t, z, out);
}

}  // namespace seiche
