// Up to sixteen members that advance together, each with its own state and status.
#pragma once

#include <seiche/core/simd/panel.hpp>
#include <seiche/simulation/simulation.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace seiche {

struct EnsembleMember {
  std::shared_ptr<const Problem> problem;  // members that have the same one share its matrices
  Vector initial;                          // physical values, as Problem::initial
};

struct MemberStatus {
  bool running = true;
  std::string message;     // why it does not run, with the numbers
  std::int64_t steps = 0;  // taken, and the time they led to, by a member that failed
  double t = 0.0;
  std::int64_t scalar_iterations = 0, fallbacks = 0, unresolved = 0;
  ReplacedSteps replaced;
  std::string fed;  // by its friction: where first, in a sentence

  void archive(Archive& a) {
    a(running, message, steps, t, scalar_iterations, fallbacks, unresolved, replaced, fed);
    a.require(steps >= 0);
  }
};

// One member after the other by its ordinary stepper: every method on every problem.
class MemberBlock {
 public:
  // A member that cannot start is not running, with the reason. `members` outlives the block.
  MemberBlock(std::span<const EnsembleMember> members, const SimulationOptions& options);
  virtual ~MemberBlock() = default;

  Index size() const { return static_cast<Index>(states_.size()); }
  const MemberStatus& status(Index member) const { return statuses_[static_cast<std::size_t>(member)]; }
  // As it is integrated; null for a member whose problem never started.
  const Simulation* simulation(Index member) const { return simulations_[static_cast<std::size_t>(member)]; }

  void set_time(double t);                // at which all start, if not at 0
  void set_streams(std::uint64_t first);  // of random numbers, one for each member

  // Step number n of all that run, from t to t + h, which the time grid calls t_after. A member that fails stays where
  // it was, and the others go on.
  void step(std::int64_t n, double t, double h, double t_after);
  // How far a member has come.
  std::int64_t steps(Index member) const { return status(member).running ? steps_ : status(member).steps; }
  double time(Index member) const { return status(member).running ? t_ : status(member).t; }
  // Of all that run. A member whose energy is no finite number fails.
  void read(std::array<EnergyReading, panel_members>& readings);
  Vector physical(Index member);     // the last good state
  virtual void archive(Archive& a);  // read into a block of the same members

 protected:
  virtual void step_all(std::int64_t n, double t, double h);
  virtual void read_energies(std::array<EnergyReading, panel_members>& readings);
  virtual void update_state(Index /*member*/) {}  // makes state(member) what the member is at

  State& state(Index member) { return states_[static_cast<std::size_t>(member)]; }
  Simulation& stepper_of(Index member) { return *simulations_[static_cast<std::size_t>(member)]; }
  // By the ordinary stepper; the state is at t.
  bool step_alone(Index member, std::int64_t n, double t, double h);
  void fail(Index member, std::string message);
  void fail_step(Index member, std::string message);  // of a state at t; says where V ends, if it does
  MemberStatus& status_of(Index member) { return statuses_[static_cast<std::size_t>(member)]; }

 private:
  static void remember_fed(const Simulation& simulation, MemberStatus& status);
  void start(Index member, const EnsembleMember& from, const SimulationOptions& options);

  std::span<const EnsembleMember> members_;
  std::map<const Problem*, std::unique_ptr<Simulation>> by_problem_;
  std::vector<Simulation*> simulations_;
  std::vector<State> states_;
  std::vector<MemberStatus> statuses_;
  std::int64_t steps_ = 0;
  double t_ = 0.0, h_ = 0.0;
};

}  // namespace seiche
