// Which step size comes next.
#pragma once

namespace seiche {

// Error per unit step, so that the errors of a run add up to about the tolerance, whatever the number of steps; a PI
// controller (Gustafsson 1991) on the estimates of a method of order p:
//   h ← h (θ/e)^{0.7/p} (e'/θ)^{0.4/p},  θ = ½,  e = error / (c · tolerance · h),  e' the one of the last accepted step,
// and after a rejection h ← h max(0.2, (θ/e)^{1/p}). A new h costs as much as many steps, for everything that is computed once
// for each: steps are powers of 2^{1/4}, and stay where the one wanted is hardly shorter, or longer by less than that. Until
// errors first come near to what is allowed, the first steps grow by (θ/e)^{1/p}, up to four times.
class StepController {
 public:
  // tolerance: of the solution at the end of a run of length one or more, in the max norm of its values
  StepController(int order, double tolerance);

  static double rounded(double h);  // down to a power of 2^{1/4}
  // Of what share of the time |z|/|ż| in which a solution changes the first step is to be: one step's error, θᵖ, is then about
  // the tolerance.
  double first_share() const;

  // of an estimate for a step of length h; errors below `noise` count as none; false for NaN
  bool accepts(double error, double h, double noise);
  double next(double h) const;  // after `accepts`
  void reset();                 // as new

 private:
  double order_, tolerance_, allowed_;
  double scaled_ = 0, previous_ = 0.5;  // of the last attempt, and of the last accepted step before it
  bool accepted_ = true, starts_ = true;
};

}  // namespace seiche
