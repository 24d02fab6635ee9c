#include <seiche/output/energy_trace.hpp>

#include <fmt/format.h>

namespace seiche {
namespace {

constexpr const char* file_name = "energy.csv";

}  // namespace

EnergyTrace::EnergyTrace(const Folder& folder, bool has_modified_energy, Schedule schedule, bool ledger)
    : file_(folder, file_name), has_modified_energy_(has_modified_energy), has_ledger_(ledger), schedule_(schedule) {
  std::string header = has_modified_energy ? "t,H,H_modified" : "t,H";
  if (ledger) {
    for (const LedgerPart& part : ledger_parts()) header += fmt::format(",{}", part.name);
    header += ",round_off";
  }
  file_.write(header + "\n");
  file_.flush();  // whoever looks sees that the run has begun
}

EnergyTrace::EnergyTrace(const Folder& folder, const Mark& mark, bool has_modified_energy, Schedule schedule,
                         bool ledger)
    : file_(folder, file_name, mark.file),
      has_modified_energy_(has_modified_energy),
      has_ledger_(ledger),
      schedule_(schedule),
      last_(mark.last),
      is_first_(mark.is_first) {}

std::string EnergyTrace::complaint(const Folder& folder, const Mark& mark) {
  return complaint_about(folder, file_name, mark.file);
}

void EnergyTrace::Mark::archive(Archive& a) {
  a(file.length, file.checksum, is_first);
  a.numbers(last);
}

EnergyTrace::Mark EnergyTrace::mark() { return {.file = file_.mark(), .last = last_, .is_first = is_first_}; }

void EnergyTrace::observe(const State& state, const EnergyReading& energy) {
  row_.clear();
  row_.add(state.t);
  row_.add(energy.H);
  if (has_modified_energy_) row_.add(energy.modified);
  if (has_ledger_) add_ledger(energy);
  file_.write(row_.line());
  file_.keep_lines();
}

void EnergyTrace::add_ledger(const EnergyReading& energy) {
  if (is_first_) last_ = energy;
  is_first_ = false;
  StepLedger change = energy.ledger;
  change -= last_.ledger;
  for (const LedgerPart& part : ledger_parts()) row_.add(change.*part.value);
  row_.add((energy.H - last_.H) - change.sum());
  last_ = energy;
}

void EnergyTrace::finish(const RunReport&) { file_.commit_lines(); }

}  // namespace seiche
