#include <seiche/core/base/error.hpp>
#include <seiche/ensemble/member_block.hpp>
#include <seiche/simulation/end_of_potential.hpp>

#include <cmath>
#include <utility>

namespace seiche {

MemberBlock::MemberBlock(std::span<const EnsembleMember> members, const SimulationOptions& options)
    : members_(members), simulations_(members.size(), nullptr), states_(members.size()), statuses_(members.size()) {
  for (std::size_t m = 0; m < members.size(); ++m) start(static_cast<Index>(m), members[m], options);
}

void MemberBlock::start(Index member, const EnsembleMember& from, const SimulationOptions& options) {
  std::unique_ptr<Simulation>& simulation = by_problem_[from.problem.get()];
  State& s = state(member);
  try {
    if (!simulation) {
      Problem problem = *from.problem;
      problem.initial = from.initial;
      // Blocks run beside each other, and what one's members meet is not the others'.
      if (problem.friction)
        if (FrictionPointer own = problem.friction->with_own_memory()) problem.friction = std::move(own);
      simulation = std::make_unique<Simulation>(problem, options);
      s = simulation->state();
    } else {
      const Space& space = *simulation->system().space;
      s.z.setZero(space.size());
      space.from_physical(from.initial, s.z);
      simulation->stepper().begin(s);
    }
  } catch (const Error& error) {
    s.z.resize(0);  // there is no good state
    fail(member, error.what());
  }
  simulations_[static_cast<std::size_t>(member)] = simulation.get();
}

void MemberBlock::set_time(double t) {
  t_ = t;
  for (State& s : states_) s.t = t;
  for (MemberStatus& status : statuses_) status.t = t;
}

void MemberBlock::set_streams(std::uint64_t first) {
  for (State& s : states_) s.stream = first++;
}

void MemberBlock::step(std::int64_t n, double t, double h, double t_after) {
  h_ = h;
  step_all(n, t, h);
  steps_ = n;
  t_ = t_after;
}

void MemberBlock::step_all(std::int64_t n, double t, double h) {
  for (Index m = 0; m < size(); ++m)
    if (status(m).running) step_alone(m, n, t, h);
}

bool MemberBlock::step_alone(Index member, std::int64_t n, double t, double h) {
  State& s = state(member);
  s.t = t;
  s.n = n - 1;
  StepReport report;
  try {
    report = stepper_of(member).stepper().step(s, h);
  } catch (const Error& error) {  // a propagator that does not exist
    report.status = StepReport::Status::failed;
    report.message = error.what();
  }
  MemberStatus& status = status_of(member);
  remember_fed(stepper_of(member), status);
  status.scalar_iterations += report.scalar_iterations;
  status.fallbacks += report.fallbacks;
  status.unresolved += report.unresolved;
  status.replaced += report.replaced;
  if (report.solved()) return true;
  fail_step(member, fmt::format("step {} failed after t = {:.9g}: {}", n, t, report.message));
  return false;
}

// What the friction of a simulation has met since it was asked last was met by this member: others may share it.
void MemberBlock::remember_fed(const Simulation& simulation, MemberStatus& status) {
  const FrictionPointer& friction = simulation.problem().friction;
  if (!friction) return;
  if (status.fed.empty()) status.fed = friction->complaint();
  friction->forget_fed();
}

void MemberBlock::fail(Index member, std::string message) {
  MemberStatus& status = status_of(member);
  status.steps = steps_;
  status.t = t_;
  status.running = false;
  status.message = std::move(message);
}

void MemberBlock::fail_step(Index member, std::string message) {
  const Simulation& by = stepper_of(member);
  const Vector& initial = members_[static_cast<std::size_t>(member)].initial;
  const std::string why = end_of_potential(by.problem(), by.system(), initial, state(member), h_);
  fail(member, why.empty() ? std::move(message) : fmt::format("{}; {}", message, why));
}

void MemberBlock::read(std::array<EnergyReading, panel_members>& readings) {
  read_energies(readings);
  for (Index m = 0; m < size(); ++m) {
    const EnergyReading& reading = readings[static_cast<std::size_t>(m)];
    if (!status(m).running || (std::isfinite(reading.H) && std::isfinite(reading.modified))) continue;
    update_state(m);
    state(m).t = t_;
    fail_step(m, fmt::format("the energy is no longer finite at t = {:.9g} (step {})", t_, steps_));
  }
}

void MemberBlock::read_energies(std::array<EnergyReading, panel_members>& readings) {
  for (Index m = 0; m < size(); ++m)
    if (status(m).running) readings[static_cast<std::size_t>(m)] = stepper_of(m).stepper().energy(state(m));
}

// Of a member that failed the last state may be anything; no step is taken from it.
void MemberBlock::archive(Archive& a) {
  a(steps_, t_);
  a.require(steps_ >= 0 && std::isfinite(t_));
  for (Index m = 0; m < size(); ++m) {
    if (simulation(m) != nullptr && status(m).running) update_state(m);
    a(status_of(m));
    State& s = state(m);
    const Index unknowns = s.z.size();
    if (!status(m).running) {
      a(s.z);
    } else {
      a.require(simulation(m) != nullptr);
      a(s);
    }
    a.require(s.z.size() == unknowns);
  }
}

Vector MemberBlock::physical(Index member) {
  if (simulation(member) == nullptr || state(member).z.size() == 0) return {};
  if (status(member).running) update_state(member);
  return simulation(member)->system().space->physical(state(member).z);
}

}  // namespace seiche
