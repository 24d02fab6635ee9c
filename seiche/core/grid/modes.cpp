#include <seiche/core/grid/modes.hpp>

namespace seiche {

Modes::Modes(const Grid& grid) : dimension_(grid.dimension()), pairs_(grid.is_periodic()), here_(grid.here) {
  for (Index a = 0; a < dimension_; ++a) {
    const auto i = static_cast<std::size_t>(a);
    const GridAxis& axis = grid.axis(a);
    boundaries_[i] = axis.boundary;
    first_.period[i] = axis.boundary == Boundary::periodic ? axis.intervals : 2 * axis.intervals;
    sizes_[i] = pairs_ && a == dimension_ - 1 ? axis.intervals / 2 + 1 : axis.unknowns();
  }
  if (dimension_ > 1) {
    plane_ = (pairs_ ? 2 : 1) * sizes_[0] * sizes_[2];
    units_ = units_of(units_in_eights(sizes_[1], plane_), here_);
    sizes_[1] = units_.planes;
    first_plane_ = slab_of_rank(here_.index).first;
  } else {
    plane_ = (pairs_ ? 2 : 1) * sizes_[0];
  }
  count_ = sizes_[0] * sizes_[1] * sizes_[2];
}

Slab Modes::slab_of_rank(int rank) const {
  return dimension_ > 1 ? slab_of(units_.whole(), {rank, here_.count}) : Slab{0, 1};
}

Mode Modes::operator[](Index index) const {
  Mode mode = first_;
  for (const std::size_t i : {2U, 0U, 1U}) {  // from the fastest on; axes that are not there have one mode
    if (static_cast<Index>(i) >= dimension_) continue;
    const Index position = index % sizes_[i] + (i == 1 ? first_plane_ : 0);
    index /= sizes_[i];
    switch (boundaries_[i]) {
      case Boundary::dirichlet: mode.k[i] = position + 1; break;
      case Boundary::neumann: mode.k[i] = position; break;
      case Boundary::periodic:  // half-complex order: cosines up, then sines down; or k and its negatives
        mode.k[i] = pairs_ || 2 * position <= mode.period[i] ? position : mode.period[i] - position;
        break;
    }
  }
  return mode;
}

}  // namespace seiche
