// One-dimensional transforms of the lines of a grid along its last axis, in batches that stay in the cache.
#pragma once

#include <seiche/backend/fft/batches.hpp>
#include <seiche/core/grid/grid.hpp>

#include <memory>

namespace seiche {

// Lines along the last axis, where numbers lie side by side. Unscaled; a transform and its inverse may be executed on
// several threads at once, with different arrays.
class RowTransform {
 public:
  virtual ~RowTransform() = default;
  virtual Index values() const = 0;  // numbers per row
  virtual Index slots() const = 0;
  virtual void to_slots(const double* values, double* slots, Index rows) const = 0;  // `rows` of one of the batches
  virtual void to_values(double* slots, double* values, Index rows) const = 0;       // overwrites slots
};

// How many rows fill part of the cache with their values: an even number, or one long row.
Index rows_of_batch(Index length);

std::unique_ptr<RowTransform> fourier_rows(Index length, const Batches& rows, bool alone_are_real, bool measure);
// `is_only_one`: of all rows of the grid, which is transformed on one thread alone.
std::unique_ptr<RowTransform> real_rows(const GridAxis& axis, const Batches& rows, bool is_only_one, bool measure);

}  // namespace seiche
