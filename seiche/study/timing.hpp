// CPU time of steps without observers, fit for ratios: the clock of the thread, a warm-up, medians, and rounds in
// which the methods take turns, so that a slow moment of the machine meets all of them.
#pragma once

#include <seiche/simulation/simulation.hpp>

#include <atomic>
#include <span>
#include <vector>

namespace seiche {

struct TimingOptions {
  int repeats = 3;        // at least so many runs of each, …
  double seconds = 0.02;  // … and at least so much time
  double warm_up_seconds = 0.002;
  const std::atomic<bool>* stop = nullptr;
};

double thread_cpu_seconds();

// Median CPU time of a run from z₀ to t_end, for each of the simulations; restarts them.
std::vector<double> time_runs(std::span<Simulation* const> simulations, double h, double t_end,
                              const TimingOptions& options = {});

}  // namespace seiche
