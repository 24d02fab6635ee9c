// What a run leaves in a Solution.
#pragma once

#include <seiche/core/observer.hpp>
#include <seiche/simulation/solve.hpp>

namespace seiche {

// With variable steps, times that are asked for come from the loop (next_time); with steps of one size, and where the
// method has a modified energy, it finds the state there itself.
class SolutionRecorder final : public Observer {
 public:
  // All outlive it. `stop` is set where the options ask for an end.
  SolutionRecorder(const SolveOptions& options, const Simulation& simulation, const RememberingStepper& steps,
                   StepReplay& replay, std::atomic<bool>& stop, Solution& solution);

  bool is_due(const State& state, bool last) const override;
  void observe(const State& state, const EnergyReading& energy) override;
  double next_time() const override;
  void finish(const RunReport&) override {}
  // Beside the times asked for, the state where a run ended before its time.
  void record_end(const State& state, const EnergyReading& energy);
  void archive(Archive& a);  // with what is in the Solution so far

 private:
  void record(const State& state, const EnergyReading& energy);
  void record_asked(const State& state, const EnergyReading& energy);
  void show(const State& state, const EnergyReading& energy);

  const SolveOptions& options_;
  const Simulation& simulation_;
  const RememberingStepper& steps_;
  StepReplay& replay_;
  std::atomic<bool>& stop_;
  Solution& solution_;
  bool has_modified_;
  std::size_t asked_ = 0;  // the next of t_eval
  Vector physical_;
};

}  // namespace seiche
