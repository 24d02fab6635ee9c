#include <seiche/loop/step_controller.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

constexpr double aim = 0.5;     // θ
constexpr double least = 1e-4;  // of errors, so that one lucky step does not throw the next one far
constexpr double near = 1e-2;   // an error that tells what step will do
constexpr double steps_per_octave = 4;

// How much of the tolerance an estimate may take: from runs on the oscillator, Klein–Gordon, α-FPU and gKdV problems at
// six tolerances, for errors between tolerance/100 and tolerance · 10 (test/loop/adaptive_test.cpp).
double calibration(int order) { return order >= 8 ? 0.8 : order >= 6 ? 0.7 : order >= 4 ? 0.5 : 0.25; }

}  // namespace

StepController::StepController(int order, double tolerance)
    : order_(order), tolerance_(tolerance), allowed_(calibration(order) * tolerance) {}

double StepController::rounded(double h) {
  return std::exp2(std::floor(steps_per_octave * std::log2(h) + 1e-9) / steps_per_octave);
}

double StepController::first_share() const { return std::clamp(0.25 * std::pow(tolerance_, 1 / order_), 1e-3, 0.1); }

void StepController::reset() {
  scaled_ = settled_ = 0;
  previous_ = aim;
  accepted_ = starts_ = true;
}

bool StepController::accepts(double error, double h, double noise) {
  if (settled_ == 0) settled_ = h;
  if (accepted_ && scaled_ > 0) previous_ = scaled_;
  if (!(error >= 0))
    scaled_ = std::numeric_limits<double>::infinity();
  else
    scaled_ = error <= noise ? least : std::max(least, error / (allowed_ * std::max(h, settled_ / 4)));
  accepted_ = scaled_ <= 1;
  if (accepted_) settled_ = std::max(h, 0.9 * settled_);
  starts_ = starts_ && scaled_ < near;
  return accepted_;
}

double StepController::next(double h) const {
  const double wanted = std::pow(aim / scaled_, 1 / order_);
  if (!accepted_) return rounded(h * std::max(0.2, wanted));
  if (starts_) return rounded(h * std::min(2.0, wanted));
  const double next_above = std::exp2(1 / steps_per_octave);
  if (wanted > 0.94 && wanted < next_above) return h;
  const double factor = std::pow(aim / scaled_, 0.7 / order_) * std::pow(previous_ / aim, 0.4 / order_);
  return rounded(h * (wanted > 1 ? std::clamp(factor, next_above, 2.0) : std::clamp(factor, 0.3, 0.94)));
}

}  // namespace seiche
