// A problem with a method, ready to run: what `solve` and the runs of cases have in common.
#pragma once

#include <seiche/core/observer.hpp>
#include <seiche/loop/integrate.hpp>
#include <seiche/simulation/certificate.hpp>
#include <seiche/simulation/simulation.hpp>

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace seiche {

struct RunPlan {
  SimulationOptions simulation;
  double h = 0.0;                     // the step size; beside a tolerance the first one, or 0
  std::optional<double> tolerance{};  // steps of variable size
  double h_max = 0.0;                 // and none longer than this; 0: no bound
  double t_start = 0.0, t_end = 0.0;
};

class PreparedRun {
 public:
  // Throws Error as Simulation and `certify` do. What structure leaves open is not looked at along a solution of its
  // own: beside a run that would be dear.
  PreparedRun(const Problem& problem, const RunPlan& plan);

  Simulation& simulation() { return *simulation_; }
  const std::shared_ptr<Simulation>& shared_simulation() const { return simulation_; }
  AdaptiveStepper* adaptive() const { return adaptive_; }           // null: steps of one size
  const std::vector<std::string>& notes() const { return notes_; }  // on step size and threads
  const Certificate& certificate() const { return certificate_; }
  LawPromise promise() const;  // for these times

  // To t_end, by the steppers of the simulation or by such that wrap them.
  RunReport integrate(Stepper& stepper, AdaptiveStepper* adaptive, const std::atomic<bool>& stop,
                      std::span<Observer* const> observers, std::span<const Event> events = {},
                      const Resumption& resumption = {});
  RunReport integrate(const std::atomic<bool>& stop, std::span<Observer* const> observers,
                      const Resumption& resumption = {}) {
    return integrate(simulation_->stepper(), adaptive_, stop, observers, {}, resumption);
  }
  // As it is after a run, which has met what no sample showed.
  Certificate certificate_after(const RunReport& report) const;

 private:
  void withdraw_law(const std::string& why);  // by what another process has found

  RunPlan plan_;
  bool varies_;  // damping changes in time, or with the state
  std::shared_ptr<Simulation> simulation_;
  AdaptiveStepper* adaptive_;
  std::vector<std::string> notes_;
  Certificate certificate_;
};

}  // namespace seiche
