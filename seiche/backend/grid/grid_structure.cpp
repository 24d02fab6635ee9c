#include <seiche/backend/grid/grid_structure.hpp>
#include <seiche/backend/grid/segment.hpp>

#include <algorithm>

namespace seiche {

GridStructure::GridStructure(const Problem& problem, std::shared_ptr<const FieldTransform> transform,
                             std::unique_ptr<LinearMap> derivative)
    : structure_(problem.structure),
      transform_(std::move(transform)),
      space_(problem.field_count(), transform_),
      derivative_(std::move(derivative)),
      slots_(transform_->slots()),
      derivative_slots_(transform_->slots()) {
  for (Vector* v : {&z_, &w_, &out_}) v->setZero(problem.size());
}

void GridStructure::differentiate(std::span<const double> u, std::span<double> out) const {
  if (!derivative_) {
    std::fill(out.begin(), out.end(), 0.0);
    return;
  }
  transform_->forward(u, all(slots_));
  derivative_->apply(slots_, derivative_slots_);
  transform_->inverse(all(derivative_slots_), out);
}

void GridStructure::apply(const Vector& z, const Vector& w, Vector& out) const {
  space_.to_physical(z, z_);
  space_.to_physical(w, w_);
  structure_->apply(
      all(z_), all(w_), [this](std::span<const double> u, std::span<double> du) { differentiate(u, du); }, all(out_));
  space_.from_physical(out_, out);
}

bool GridStructure::without_means(const Vector& z, Vector& d) const {
  if (!structure_->keeps_means()) return false;
  const Index n = transform_->unknowns();
  space_.to_physical(z, z_);
  for (Index f = 0; f * n < z_.size(); ++f) z_.segment(f * n, n).array() -= z_.segment(f * n, n).mean();
  space_.from_physical(z_, d);
  return true;
}

}  // namespace seiche
