// A scalar damping coefficient γ(t) in 1/time, with its integral.
#pragma once

#include <memory>
#include <string>

namespace seiche {

class Rate {
 public:
  virtual ~Rate() = default;
  virtual double value(double t) const = 0;
  // ∫ₜᵗ⁺ʰ γ(s) ds: exact, or by a quadrature with positive weights, so that γ ≥ 0 gives ∫γ ≥ 0. NaN
  // where it does not converge, as at a pole.
  virtual double integral(double t, double h) const = 0;
  virtual bool is_constant() const = 0;
  // A time in [0, t_end] where γ < 0 (the damping would feed energy), or a negative number if none was found.
  virtual double first_negative_time(double t_end) const = 0;
  // A time at which a negative γ was met in whatever was evaluated so far, or a negative number: sampling may miss one.
  virtual double negative_seen() const = 0;
  virtual std::string text() const = 0;
};

using RatePointer = std::shared_ptr<const Rate>;

}  // namespace seiche
