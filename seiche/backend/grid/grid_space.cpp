#include <seiche/backend/grid/grid_space.hpp>
#include <seiche/backend/grid/segment.hpp>

#include <vector>

namespace seiche {

GridSpace::GridSpace(Index fields, std::shared_ptr<const FieldTransform> transform, const Ranks* ranks)
    : fields_(fields),
      transform_(std::move(transform)),
      ranks_(ranks),
      slots_(transform_->slot_field()),
      values_(transform_->value_field()) {}

void GridSpace::sum(std::span<double> local) const {
  if (ranks_ != nullptr) ranks_->sum(local);
}

void GridSpace::max(std::span<double> local) const {
  if (ranks_ != nullptr) ranks_->max(local);
}

void GridSpace::add_units(const Units& units, std::span<const double> sums, std::span<double> totals) const {
  if (ranks_ == nullptr) return Space::add_units(units, sums, totals);
  thread_local std::vector<Index> counts;  // no step allocates
  thread_local std::vector<double> all;
  const int processes = ranks_->here().count;
  counts.clear();
  for (int rank = 0; rank < processes; ++rank)
    counts.push_back(units_of(units, {rank, processes}).count() * static_cast<Index>(totals.size()));
  all.resize(static_cast<std::size_t>(units.whole().count()) * totals.size());
  ranks_->gather(sums, counts, all);
  Space::add_units(units, all, totals);
}

void GridSpace::join(const Field& field, std::span<const double> mine,
                     FunctionRef<void(std::span<const double> piece)> take) const {
  if (ranks_ == nullptr) return Space::join(field, mine, take);
  ranks_->join(field, mine, take);
}

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
