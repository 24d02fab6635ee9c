// Which step size comes next.
#pragma once

#include <seiche/core/control/archive.hpp>

namespace seiche {

// Error per unit step, so that the errors of a run add up to about the tolerance, whatever the number of steps; a PI
// controller (Gustafsson 1991) on the estimates of a method of order p:
//   h ← h (θ/e)^{0.7/p} (e'/θ)^{0.4/p},  θ = ½,  e = error / (c · tolerance · h),  e' the one of the last accepted
//   step,
// and after a rejection h ← h max(0.2, (θ/e)^{1/p}). A new h costs as much as many steps, for all that is computed once
// for each. So steps are powers of 2^{1/4}; one that is no more than 6 % longer than (θ/e)^{1/p} wants it, or shorter
// by less than that power, stays; and a change is by one power at least. Until an error first tells something, steps
// grow by (θ/e)^{1/p}, at most twofold.
class StepController {
 public:
  // tolerance: of the solution at the end of a run of length one or more, in the max norm of its values
  StepController(int order, double tolerance);

  static double rounded(double h);  // down to a power of 2^{1/4}
  // The first step as a share of |z|/|ż|, the time in which the solution changes: its p-th power is a small part of the
  // tolerance.
  double first_share() const;

  // of an estimate for a step of length h; errors below `noise` count as none; false for NaN. Where D(t) or f(t) jumps,
  // the error of a step that holds the jump is in proportion to its length, and no step meets a bound per unit of time.
  // So steps far shorter than the last accepted one may have the error of a quarter of that: a jump costs this once.
  // At a start, which may be such a place, the first attempt stands for a step accepted before.
  bool accepts(double error, double h, double noise);
  double next(double h) const;
  double allowed() const { return allowed_; }  // error per unit of time of an accepted step, after `accepts`
  void reset();                                // as new
  void archive(Archive& a) { a(allowed_, scaled_, previous_, settled_, accepted_, starts_); }

 private:
  double order_, tolerance_, allowed_;
  double scaled_ = 0, previous_ = 0.5;  // of the last attempt, and of the last accepted step before it
  double settled_ = 0;  // the length of steps; it follows them down slowly, since they shrink on their way to a jump
  bool accepted_ = true, starts_ = true;
};

}  // namespace seiche
