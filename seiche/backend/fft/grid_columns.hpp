// One-dimensional transforms of the lines of a grid along another axis than the last, in blocks that stay in the cache.
#pragma once

#include <seiche/core/grid/grid.hpp>

#include <memory>

namespace seiche {

// Lines along another axis: `outer` × `length` × `inner` numbers, or pairs of numbers, transformed in place.
class ColumnTransform {
 public:
  virtual ~ColumnTransform() = default;
  virtual Index blocks() const = 0;
  virtual void to_slots(double* data, Index block) const = 0;
  virtual void to_values(double* data, Index block) const = 0;
};

struct Lines {
  Index outer, length, inner;
};

std::unique_ptr<ColumnTransform> fourier_columns(const Lines& lines, bool measure);
std::unique_ptr<ColumnTransform> real_columns(const GridAxis& axis, const Lines& lines, bool measure);

}  // namespace seiche
