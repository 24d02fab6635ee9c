#include <seiche/backend/grid/grid_force.hpp>
#include <seiche/backend/grid/segment.hpp>

namespace seiche {

GridForce::GridForce(const Problem& problem, std::shared_ptr<const FieldTransform> transform)
    : forces_(problem.forces),
      transform_(std::move(transform)),
      points_(transform_->unknowns()),
      slots_(transform_->slots()) {
  for (std::size_t f = 0; f < forces_.size(); ++f)
    if (forces_[f] && problem.potential_depends_on(static_cast<Index>(f))) touches_potential_ = true;
}

void GridForce::add_slots(std::size_t field, double factor, Vector& out) const {
  transform_->forward(all(points_), all(slots_));
  out.segment(static_cast<Index>(field) * slots_.size(), slots_.size()) += factor * slots_;
}

void GridForce::add(double t, double factor, Vector& out) const {
  for (std::size_t f = 0; f < forces_.size(); ++f) {
    if (!forces_[f]) continue;
    forces_[f]->values(t, all(points_));
    add_slots(f, factor, out);
  }
}

void GridForce::impulse(double t, double h, Vector& z) const {
  for (std::size_t f = 0; f < forces_.size(); ++f) {
    if (!forces_[f]) continue;
    forces_[f]->integrals(t, h, all(points_));
    add_slots(f, 1, z);
  }
}

}  // namespace seiche
