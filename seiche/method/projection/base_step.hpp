// A step without a law, for Projected to end with one.
#pragma once

#include <seiche/core/space.hpp>
#include <seiche/core/state.hpp>
#include <seiche/method/projection/step_dissipation.hpp>

#include <cmath>
#include <limits>
#include <string_view>

namespace seiche {

// True if ẑ may be a solution. `size`: |zⁿ| + h|force|, by what is known of the force before the step. False for NaN; a
// solution that has faded until its square underflows is one.
inline bool may_be_solution(const Space& space, const Vector& z, double size) {
  constexpr double gross_growth = 1e3;
  const double grown = space.squared_norm(z);
  return std::isfinite(grown) && (grown < std::numeric_limits<double>::min() || grown <= square(gross_growth * size));
}

class BaseStep {
 public:
  virtual ~BaseStep() = default;

  virtual void remember_nothing(State& /*s*/) {}  // makes room in s for what `accept` leaves there

  // z ← ẑ, the solution at t + h from s.z at t. False, with z anything, where ẑ is no solution.
  virtual bool compute(const State& s, double t, double h, Vector& z) = 0;
  virtual std::string_view failure() const = 0;  // what has happened then; a literal
  virtual std::string_view remedy() const { return "a smaller h"; }

  // Where a step finds no solution, parts of it do: they are tried before e^{hL}z.
  virtual bool may_be_solved_in_parts() const { return false; }

  // V(ẑ) of the step just computed, where that is known without looking for it; else null. Read it before the
  // next step.
  virtual const double* potential_energy(const Vector& /*z*/) { return nullptr; }

  // Of the step just computed, where a projection is a part of it: how often that found nothing better than bisection,
  // and whether it moved anything far.
  virtual int fallbacks() const { return 0; }
  virtual bool moved_far() const { return false; }

  virtual StepDissipation::Kind dissipation_kind() const = 0;
  // Of the step just computed to z with H = H(z), where the kind is not `none`.
  virtual StepDissipation::Amount dissipated(const State& s, double t, double h, const Vector& z, double H) = 0;
  // Of the same step: what `fine` of that amount misses of the linear flow; 0 where it is no quadrature.
  virtual double flow_missed(const State& /*s*/, double /*h*/) { return 0; }
  // Makes what that needs for steps of h, so that none of them allocates.
  virtual void prepare_flow(double /*h*/) {}

  // The step just computed will be taken: s is still as before it but for what this changes, and never z, t and n.
  struct Taken {
    bool resolved = true;  // or e^{hL}z was taken instead of ẑ
    double factor = 1;     // to factor · ẑ; 0: to another state
  };
  virtual void accept(State& /*s*/, double /*h*/, const Taken& /*taken*/) {}
};

}  // namespace seiche
