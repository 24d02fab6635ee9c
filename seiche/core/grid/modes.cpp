#include <seiche/core/grid/modes.hpp>

namespace seiche {

Modes::Modes(const Grid& grid) : dimension_(grid.dimension()), pairs_(grid.is_periodic()) {
  for (Index a = 0; a < dimension_; ++a) {
    const auto i = static_cast<std::size_t>(a);
    const GridAxis& axis = grid.axis(a);
    boundaries_[i] = axis.boundary;
    first_.period[i] = axis.boundary == Boundary::periodic ? axis.intervals : 2 * axis.intervals;
    sizes_[i] = pairs_ && a == dimension_ - 1 ? axis.intervals / 2 + 1 : axis.unknowns();
    count_ *= sizes_[i];
  }
}

Mode Modes::operator[](Index index) const {
  Mode mode = first_;
  for (Index a = dimension_ - 1; a >= 0; --a) {
    const auto i = static_cast<std::size_t>(a);
    const Index position = index % sizes_[i];
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
