#include <seiche/backend/grid_structure.hpp>
#include <seiche/backend/segment.hpp>

#include <algorithm>

namespace seiche {

GridStructure::GridStructure(const Problem& problem, std::shared_ptr<const FieldTransform> transform,
                             std::unique_ptr<LinearMap> derivative)
    : structure_(problem.structure),
      transform_(std::move(transform)),
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

void GridStructure::to_points(const Vector& z, Vector& points) const {
  const Index n = transform_->unknowns(), m = transform_->slots();
  for (Index f = 0; f * n < points.size(); ++f) transform_->inverse(segment(z, f * m, m), segment(points, f * n, n));
}

void GridStructure::to_slots(const Vector& points, Vector& z) const {
  const Index n = transform_->unknowns(), m = transform_->slots();
  for (Index f = 0; f * n < points.size(); ++f) transform_->forward(segment(points, f * n, n), segment(z, f * m, m));
}

void GridStructure::apply(const Vector& z, const Vector& w, Vector& out) const {
  to_points(z, z_);
  to_points(w, w_);
  structure_->apply(
      all(z_), all(w_), [this](std::span<const double> u, std::span<double> du) { differentiate(u, du); }, all(out_));
  to_slots(out_, out);
}

bool GridStructure::without_means(const Vector& z, Vector& d) const {
  if (!structure_->keeps_means()) return false;
  const Index n = transform_->unknowns();
  to_points(z, z_);
  for (Index f = 0; f * n < z_.size(); ++f) z_.segment(f * n, n).array() -= z_.segment(f * n, n).mean();
  to_slots(z_, d);
  return true;
}

}  // namespace seiche
