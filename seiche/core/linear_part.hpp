// S and M in the coordinates of State::z.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/propagator.hpp>

#include <cstdint>
#include <memory>
#include <optional>

namespace seiche {

// What a linear solver that stops at a tolerance has done for propagators: iterations, and the largest relative move by
// which they restored their contract afterwards (restoring_pade_propagator).
struct SolverShare {
  std::int64_t iterations = 0;
  double restored = 0.0;
};

class LinearPart {
 public:
  virtual ~LinearPart() = default;
  virtual void apply_S(const Vector& z, Vector& out) const = 0;
  // out ← ½(S + Sᵀ)z; false, and out as it was, where S is skew. The first call may allocate.
  virtual bool apply_symmetric_S(const Vector& z, Vector& out) const = 0;
  virtual void apply_M(const Vector& z, Vector& out) const = 0;
  virtual double quadratic_energy(const Vector& z) const = 0;     // ½zᵀMz
  virtual double quadratic_magnitude(const Vector& z) const = 0;  // ½|z|ᵀ|M||z|, the scale of its round-off
  virtual ValueAndMagnitude quadratic(const Vector& z) const { return {quadratic_energy(z), quadratic_magnitude(z)}; }
  virtual std::unique_ptr<Propagator> propagator(PropagatorKind kind, double h) const = 0;
  virtual std::optional<SolverShare> solver_share() const { return {}; }  // nothing: propagators are to round-off
};

}  // namespace seiche
