// One-dimensional transforms of all lines of a grid along one axis, in batches that stay in the cache.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/core/vector.hpp>

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

// Lines along another axis: `outer` × `length` × `inner` numbers, or pairs of numbers, transformed in place.
class ColumnTransform {
 public:
  virtual ~ColumnTransform() = default;
  virtual Index blocks() const = 0;
  virtual void to_slots(double* data, Index block) const = 0;
  virtual void to_values(double* data, Index block) const = 0;
};

// Factors of numbers between FFTW's sums along one axis and orthonormal coordinates; those of the modes whose conjugate
// is not held too (constant, alternating) are √2 larger before to_values, and smaller after to_slots, which the
// transforms above see to.
double slot_scale(const GridAxis& axis);
double value_scale(const GridAxis& axis);

struct Lines {
  Index outer, length, inner;
};

std::unique_ptr<RowTransform> fourier_rows(Index length, Index rows, bool alone_are_real, bool measure);
std::unique_ptr<RowTransform> real_rows(const GridAxis& axis, Index rows, bool measure);
std::unique_ptr<RowTransform> sine_row(Index intervals, bool measure);  // one row between two ends where u = 0
std::unique_ptr<ColumnTransform> fourier_columns(const Lines& lines, bool measure);
std::unique_ptr<ColumnTransform> real_columns(const GridAxis& axis, const Lines& lines, bool measure);

}  // namespace seiche
