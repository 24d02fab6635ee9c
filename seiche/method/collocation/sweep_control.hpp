// How many fixed-point sweeps over the forces of a collocation step are worth their work.
#pragma once

namespace seiche {

// A sweep changes the solution by δ₁, the next by δ₂, …, and δₖ₊₁ ≈ δₖ²/δₖ₋₁ or less is what k sweeps leave. That need
// only be small beside the error of the collocation step itself: s sweeps are enough, and of three or more fewer where
// the nonlinearity is weak.
class SweepControl {
 public:
  // `from_history`: the first guess extrapolates the forces of the step before. Otherwise 2s sweeps are made.
  // `may_save`: fewer sweeps may do, where error() below says so.
  SweepControl(int stages, bool from_history, bool may_save)
      : stages_(stages), from_history_(from_history), may_save_(from_history && may_save && stages > 2) {}

  // After a sweep that changed the solution by about `change`. error(): about the error of the step.
  template <class Error>
  bool wants_another(double change, const Error& error) {
    ++sweeps_;
    const double before = change_;
    change_ = change;
    const int planned = from_history_ ? stages_ : 2 * stages_;
    const bool converges = change < slowest * before;  // false for NaN
    if (sweeps_ >= planned) return false;
    if (!may_save_ || sweeps_ < least) return true;
    if (change == 0) return false;
    return !converges || change / before * change > small * error();
  }

  // True if the next sweep may be the last.
  bool may_be_last() const { return sweeps_ + 1 >= (may_save_ ? least : from_history_ ? stages_ : 2 * stages_); }

 private:
  static constexpr int least = 2;
  static constexpr double slowest = 0.3;  // a sweep that gains less gives nothing to go by
  static constexpr double small = 0.5;

  int stages_;
  bool from_history_, may_save_;
  int sweeps_ = 0;
  double change_ = 0;
};

}  // namespace seiche
