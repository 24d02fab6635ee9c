// Between the values of one field on its grid and its orthonormal coordinates in State::z.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/grid/grid.hpp>
#include <seiche/core/grid/ranks.hpp>
#include <seiche/core/grid/units.hpp>

#include <memory>
#include <span>

namespace seiche {

class FieldTransform {
 public:
  virtual ~FieldTransform() = default;
  virtual Index unknowns() const = 0;  // values per field
  virtual Index slots() const = 0;     // coordinates per field, some of which may always be zero
  virtual bool is_identity() const { return false; }

  void forward(std::span<const double> values, std::span<double> slots) const;
  void inverse(std::span<const double> slots, std::span<double> values) const;

  // The same without the passes that scale: coordinates are slot_scale() × what to_slots gives, and values are
  // value_scale() × what to_values gives of coordinates, which it overwrites.
  virtual double slot_scale() const { return 1.0; }
  virtual double value_scale() const { return 1.0; }
  virtual void to_slots(std::span<const double> values, std::span<double> slots) const = 0;
  virtual void to_values(std::span<double> slots, std::span<double> values) const = 0;

  // In planes along axis 0 of the values, and along axis 1 of the slots.
  virtual FieldPart value_field() const { return {unknowns()}; }
  virtual FieldPart slot_field() const { return {slots()}; }

  // slots ← to_slots(f(to_values(from))), where f overwrites the values of some points and returns a number: the sums
  // of these over each unit of values. f must treat every point alike and alone. Blocks of points pass through the
  // cache, on several threads. `from` has as many coordinates as `slots`, and is the same array or apart from it; then
  // it is kept.
  using Pointwise = FunctionRef<double(std::span<double> values)>;
  virtual std::span<const double> through_values(std::span<const double> from, std::span<double> slots,
                                                 const Pointwise& f) const = 0;
};

std::unique_ptr<FieldTransform> identity_transform(Index unknowns);
std::unique_ptr<FieldTransform> identity_transform(const FieldPart& part);  // of what one of several processes holds

struct TransformOptions {
  bool measure_plans = false;  // let FFTW try plans, which then differ from run to run in the last bits
  int threads = 1;
  const Ranks* ranks = nullptr;  // outlive the transform
};

// Fourier on grids that are periodic along every axis, in the order of Modes: pairs of slots (Re â, Im â). Sines,
// cosines and half-complex Fourier coefficients, axis by axis, on the others: one slot per unknown.
std::unique_ptr<FieldTransform> modal_transform(const Grid& grid, const TransformOptions& options = {});

}  // namespace seiche
