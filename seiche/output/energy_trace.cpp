#include <seiche/output/energy_trace.hpp>

namespace seiche {

EnergyTrace::EnergyTrace(const std::filesystem::path& path, bool has_modified_energy, Schedule schedule)
    : file_(path), has_modified_energy_(has_modified_energy), schedule_(schedule) {
  file_.write(has_modified_energy ? "t,H,H_modified\n" : "t,H\n");
}

void EnergyTrace::observe(const State& state, const EnergyReading& energy) {
  row_.clear();
  row_.add(state.t);
  row_.add(energy.H);
  if (has_modified_energy_) row_.add(energy.modified);
  file_.write(row_.line());
}

void EnergyTrace::finish(const RunReport&) { file_.commit(); }

}  // namespace seiche
