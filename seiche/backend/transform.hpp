// Between the values of one field on its grid and its orthonormal coordinates in State::z.
#pragma once

#include <seiche/core/grid.hpp>

#include <memory>
#include <span>

namespace seiche {

class FieldTransform {
 public:
  virtual ~FieldTransform() = default;
  virtual Index unknowns() const = 0;  // values per field
  virtual Index slots() const = 0;     // coordinates per field, some of which may always be zero
  virtual void forward(std::span<const double> values, std::span<double> slots) const = 0;
  virtual void inverse(std::span<const double> slots, std::span<double> values) const = 0;
};

std::unique_ptr<FieldTransform> identity_transform(Index unknowns);

// Fourier on grids that are periodic along every axis, in the order of Modes: pairs of slots (Re â, Im â). Sines, cosines
// and half-complex Fourier coefficients, axis by axis, on the others: one slot per unknown. `measure_plan` lets FFTW try
// plans, which then differ from run to run in the last bits.
std::unique_ptr<FieldTransform> modal_transform(const Grid& grid, bool measure_plan);

}  // namespace seiche
