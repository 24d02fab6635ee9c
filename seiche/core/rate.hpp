// Damping coefficients in 1/time, with their integrals: γ(t), and γ(x, t) on the points of a grid.
#pragma once

#include <memory>
#include <span>
#include <string>

namespace seiche {

struct TimeSpan {
  double begin, length;
};

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

// Spans hold one number per unknown of a field, in the order of the grid.
class FieldRate {
 public:
  virtual ~FieldRate() = default;
  virtual void values(double t, std::span<double> gamma) const = 0;
  // ∫ₜᵗ⁺ʰ γ(x, s) ds at every point, with the same promises as Rate::integral.
  virtual void integrals(double t, double h, std::span<double> out) const = 0;
  virtual bool is_constant() const = 0;  // in time
  // As for Rate: a time at which some point has γ < 0, or a negative number.
  virtual double first_negative_time(double t_end) const = 0;
  virtual double negative_seen() const = 0;
  virtual std::string text() const = 0;
};

using FieldRatePointer = std::shared_ptr<const FieldRate>;

}  // namespace seiche
