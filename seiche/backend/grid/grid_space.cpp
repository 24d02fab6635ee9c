#include <seiche/backend/grid/grid_space.hpp>
#include <seiche/backend/grid/segment.hpp>

namespace seiche {

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

}  // namespace seiche
