#include <seiche/run/step_controller.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

constexpr double aim = 0.5;     // θ
constexpr double least = 1e-4;  // of errors, so that one lucky step does not throw the next one far

// How much of the tolerance an estimate may take: from runs on the oscillator, Klein–Gordon, α-FPU and gKdV problems at
// six tolerances, for errors between tolerance/100 and tolerance · 10 (test/adaptive_test.cpp).
double calibration(int order) { return order >= 8 ? 1.2 : order >= 6 ? 0.7 : order >= 4 ? 0.5 : 0.25; }

}  // namespace

StepController::StepController(int order, double tolerance) : order_(order), allowed_(calibration(order) * tolerance) {}

double StepController::rounded(double h) { return std::exp2(std::floor(8 * std::log2(h)) / 8); }

void StepController::reset() {
  scaled_ = 0;
  previous_ = aim;
  accepted_ = true;
}

bool StepController::accepts(double error, double h, double noise) {
  if (accepted_ && scaled_ > 0) previous_ = scaled_;
  if (!(error >= 0))
    scaled_ = std::numeric_limits<double>::infinity();
  else
    scaled_ = error <= noise ? least : std::max(least, error / (allowed_ * h));
  accepted_ = scaled_ <= 1;
  return accepted_;
}

double StepController::next(double h) const {
  if (!accepted_) return rounded(h * std::max(0.2, std::pow(aim / scaled_, 1 / order_)));
  const double factor = std::pow(aim / scaled_, 0.7 / order_) * std::pow(previous_ / aim, 0.4 / order_);
  return rounded(h * std::clamp(factor, 0.3, 2.0));
}

}  // namespace seiche
