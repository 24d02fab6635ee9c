#include <seiche/simulation/solution_recorder.hpp>

namespace seiche {

SolutionRecorder::SolutionRecorder(const SolveOptions& options, const Simulation& simulation,
                                   const RememberingStepper& steps, StepReplay& replay, std::atomic<bool>& stop,
                                   Solution& solution)
    : options_(options),
      simulation_(simulation),
      steps_(steps),
      replay_(replay),
      stop_(stop),
      solution_(solution),
      has_modified_(steps.has_modified_energy()),
      physical_(solution.size) {}

double SolutionRecorder::next_time() const {
  return options_.t_eval && asked_ < options_.t_eval->size() ? (*options_.t_eval)[asked_]
                                                             : std::numeric_limits<double>::infinity();
}

bool SolutionRecorder::is_due(const State& state, bool last) const {
  const bool stopped = (options_.stop && options_.stop->load(std::memory_order_relaxed)) ||
                       (options_.is_stopped && options_.is_stopped(state.t, state.n));
  if (stopped) stop_.store(true, std::memory_order_relaxed);
  return last || state.n % options_.record_every == 0 || next_time() <= state.t;
}

void SolutionRecorder::observe(const State& state, const EnergyReading& energy) {
  // The loop shows a time that was asked for before it records the step around it.
  const bool is_between = options_.tolerance && !steps_.taken().empty() && next_time() <= state.t;
  if (options_.t_eval)
    record_asked(state, energy);
  else
    record(state, energy);
  if (options_.observer && !is_between && state.n % options_.record_every == 0) show(state, energy);
}

void SolutionRecorder::record_asked(const State& state, const EnergyReading& energy) {
  while (next_time() <= state.t) {
    const double t = next_time();
    ++asked_;
    const bool is_here = t == state.t && !(options_.tolerance && has_modified_);
    if (is_here || steps_.taken().empty()) {
      record(state, energy);
    } else {
      const State inside = replay_.at(steps_.taken().back(), t);
      EnergyReading reading = steps_.energy(inside);
      reading.ledger = energy.ledger;
      record(inside, reading);
    }
  }
}

void SolutionRecorder::archive(Archive& a) {
  Solution& s = solution_;
  const std::size_t events = s.events.size();
  a(s.t, s.z, s.H, s.modified, s.ledger, s.events, s.ended_by_event, asked_);
  const std::size_t times = s.t.size();
  a.require(s.events.size() == events && s.z.size() == times * static_cast<std::size_t>(s.size));
  a.require(s.H.size() == times && s.modified.size() == (has_modified_ ? times : 0));
  a.require(s.ledger.size() == (options_.ledger ? times : 0));
  for (const Solution::Events& one : s.events)
    a.require(one.z.size() == one.t.size() * static_cast<std::size_t>(s.size));
  a.require(asked_ <= (options_.t_eval ? options_.t_eval->size() : 0));
}

void SolutionRecorder::record_end(const State& state, const EnergyReading& energy) {
  if (solution_.t.empty() || solution_.t.back() < state.t) record(state, energy);
}

void SolutionRecorder::record(const State& state, const EnergyReading& energy) {
  simulation_.system().space->to_physical(state.z, physical_);
  solution_.t.push_back(state.t);
  solution_.z.insert(solution_.z.end(), physical_.begin(), physical_.end());
  solution_.H.push_back(energy.H);
  if (has_modified_) solution_.modified.push_back(energy.modified);
  if (options_.ledger) solution_.ledger.push_back(energy.ledger);
}

void SolutionRecorder::show(const State& state, const EnergyReading& energy) {
  simulation_.system().space->to_physical(state.z, physical_);
  if (!options_.observer({.t = state.t, .z = physical_, .energy = energy}))
    stop_.store(true, std::memory_order_relaxed);
}

}  // namespace seiche
