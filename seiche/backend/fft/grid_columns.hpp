// One-dimensional transforms of the lines of a grid along other axes than the last, in blocks that stay in the cache.
#pragma once

#include <seiche/core/grid/grid.hpp>

#include <memory>

namespace seiche {

// `outer` × `length` × `inner` numbers, or pairs of numbers, of which lines run along the middle one.
struct Lines {
  Index outer, length, inner;
};

class ColumnTransform {
 public:
  virtual ~ColumnTransform() = default;
  virtual Index blocks() const = 0;
  // Of one block. Both may overwrite what they read, but for Fourier columns that are turned: they keep it.
  virtual void to_slots(double* values, double* slots, Index block) const = 0;
  virtual void to_values(double* slots, double* values, Index block) const = 0;
};

// In place.
std::unique_ptr<ColumnTransform> fourier_columns(const Lines& lines, bool measure);
std::unique_ptr<ColumnTransform> real_columns(const GridAxis& axis, const Lines& lines, bool measure);

// Along axis 0 of a grid of `axis 0` × `middle` × `inner` numbers or pairs, which become slots `middle` × `axis 0` ×
// `inner`: lines lie close together then, where they are long side by side.
struct Turned {
  Index length, middle, inner;
  Index stride = middle * inner;  // from one plane along axis 0 to the next
};
std::unique_ptr<ColumnTransform> turned_fourier_columns(const Turned& lines, bool measure);
std::unique_ptr<ColumnTransform> turned_real_columns(const GridAxis& axis, const Turned& lines, bool measure);

}  // namespace seiche
