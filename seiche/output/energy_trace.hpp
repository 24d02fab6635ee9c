// energy.csv: t, H and, for methods that have one, the modified energy at every due step. Streamed, so that a long
// run costs no memory.
#pragma once

#include <seiche/core/observer.hpp>
#include <seiche/output/atomic_file.hpp>
#include <seiche/output/csv_row.hpp>

namespace seiche {

class EnergyTrace : public Observer {
 public:
  EnergyTrace(const std::filesystem::path& path, bool has_modified_energy, Schedule schedule = {});

  bool is_due(const State& state, bool last) const override { return schedule_.is_due(state.n, last); }
  void observe(const State& state, const EnergyReading& energy) override;
  void finish(const RunReport& report) override;

 private:
  AtomicFile file_;
  bool has_modified_energy_;
  Schedule schedule_;
  CsvRow row_;
};

}  // namespace seiche
