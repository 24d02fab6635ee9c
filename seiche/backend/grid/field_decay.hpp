// A damping γ(x, t) on one field: multiplication at the points of the grid, in whichever coordinates the field is held.
#pragma once

#include <seiche/backend/fft/transform.hpp>
#include <seiche/core/base/vector.hpp>
#include <seiche/core/rate.hpp>
#include <seiche/core/step_cache.hpp>

#include <memory>
#include <span>

namespace seiche {

class FieldDecay {
 public:
  FieldDecay(FieldRatePointer rate, std::shared_ptr<const FieldTransform> transform);
  // exp(−∫ₜᵗ⁺ʰ γ(x_j, s) ds), valid until the next call; kept for each h where γ does not depend on t.
  const Vector& factors(double t, double h) const;
  const Vector& values(double t) const;                                 // γ(x_j, t), valid until the next call
  const Vector& integrals(double t, double h) const;                    // ∫ₜᵗ⁺ʰ γ(x_j, s) ds, likewise
  bool is_constant() const { return rate_->is_constant(); }             // in time
  void multiply(const Vector& factors, std::span<double> slots) const;  // point by point

 private:
  void set_factors(double t, double h, Vector& factors) const;

  FieldRatePointer rate_;
  std::shared_ptr<const FieldTransform> transform_;
  mutable StepCache<Vector> constant_;  // factors, where γ does not depend on t
  mutable Vector current_;              // at the points
  mutable Vector physical_;             // the field, at the points
};

}  // namespace seiche
