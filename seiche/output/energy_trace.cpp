#include <seiche/output/energy_trace.hpp>

#include <fmt/format.h>

namespace seiche {

EnergyTrace::EnergyTrace(const std::filesystem::path& path, bool has_modified_energy, Schedule schedule, bool ledger)
    : file_(path), has_modified_energy_(has_modified_energy), has_ledger_(ledger), schedule_(schedule) {
  file_.write(
      fmt::format("t,H{}{}\n", has_modified_energy ? ",H_modified" : "",
                  ledger ? ",work,damping_left,substep,scalar,auxiliary,projection,damping_right,round_off" : ""));
}

void EnergyTrace::observe(const State& state, const EnergyReading& energy) {
  row_.clear();
  row_.add(state.t);
  row_.add(energy.H);
  if (has_modified_energy_) row_.add(energy.modified);
  if (has_ledger_) add_ledger(energy);
  file_.write(row_.line());
}

void EnergyTrace::add_ledger(const EnergyReading& energy) {
  if (is_first_) last_ = energy;
  is_first_ = false;
  const StepLedger& now = energy.ledger;
  const StepLedger& before = last_.ledger;
  StepLedger change{.work = now.work - before.work,
                    .damping_left = now.damping_left - before.damping_left,
                    .substep = now.substep - before.substep,
                    .scalar = now.scalar - before.scalar,
                    .auxiliary = now.auxiliary - before.auxiliary,
                    .projection = now.projection - before.projection,
                    .damping_right = now.damping_right - before.damping_right};
  for (const double part : {change.work, change.damping_left, change.substep, change.scalar, change.auxiliary,
                            change.projection, change.damping_right, (energy.H - last_.H) - change.sum()})
    row_.add(part);
  last_ = energy;
}

void EnergyTrace::finish(const RunReport&) { file_.commit(); }

}  // namespace seiche
