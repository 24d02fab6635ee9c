// One-dimensional transforms of the lines of a grid along its last axis, in batches that stay in the cache.
#pragma once

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
  virtual Index batch() const = 0;                                                   // rows per call, at most
  virtual void to_slots(const double* values, double* slots, Index rows) const = 0;  // `rows` = batch, or the rest
  virtual void to_values(double* slots, double* values, Index rows) const = 0;       // overwrites slots
};

std::unique_ptr<RowTransform> fourier_rows(Index length, Index rows, bool alone_are_real, bool measure);
std::unique_ptr<RowTransform> real_rows(const GridAxis& axis, Index rows, bool measure);

}  // namespace seiche
