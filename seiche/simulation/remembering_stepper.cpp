#include <seiche/simulation/remembering_stepper.hpp>

#include <cstdint>

namespace seiche {

void RememberingStepper::note(double h) {
  if (keeps_ == Keeps::none) return;
  while (!taken_.empty() && (keeps_ == Keeps::last || taken_.back().left.t >= left_.t)) taken_.pop_back();
  taken_.push_back({left_, h});
}

StepReport RememberingStepper::step(State& state, double h) {
  if (keeps_ != Keeps::none) left_ = state;
  StepReport report = stepper_.step(state, h);
  if (report.solved()) note(h);
  return report;
}

StepReport RememberingStepper::attempt(State& state, double h) {
  if (keeps_ != Keeps::none) left_ = state;
  StepReport report = adaptive_->attempt(state, h);
  if (report.solved()) note(h);
  return report;
}

void RememberingStepper::undo(State& state) {
  adaptive_->undo(state);
  if (!taken_.empty()) taken_.pop_back();
}

void RememberingStepper::archive(Archive& a, const State& like) {
  std::uint64_t count = taken_.size();
  a(count);
  if (a.reads()) taken_.clear();
  for (std::uint64_t k = 0; k < count; ++k) {
    if (a.reads()) taken_.push_back({like, 0.0});
    a(taken_[k]);
  }
}

std::vector<TakenStep> RememberingStepper::release(double t_end) {
  while (!taken_.empty() && taken_.back().left.t >= t_end) taken_.pop_back();
  return std::move(taken_);
}

}  // namespace seiche
