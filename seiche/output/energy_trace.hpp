// energy.csv: t, H and, for methods that have one, the modified energy at every due step; with a ledger also where
// the change of H since the row before comes from (StepLedger), its last column what is left, round-off. Streamed, so
// that a long run costs no memory.
#pragma once

#include <seiche/core/control/archive.hpp>
#include <seiche/core/observer.hpp>
#include <seiche/output/csv_row.hpp>
#include <seiche/output/file/atomic_file.hpp>

#include <string>

namespace seiche {

class EnergyTrace : public Observer {
 public:
  // As far as it had come at a checkpoint.
  struct Mark {
    FileMark file;
    EnergyReading last;
    bool is_first = true;
    void archive(Archive& a);
  };

  EnergyTrace(const Folder& folder, bool has_modified_energy, Schedule schedule = {}, bool ledger = false);
  // Goes on behind the mark in the file that an earlier run has left.
  EnergyTrace(const Folder& folder, const Mark& mark, bool has_modified_energy, Schedule schedule, bool ledger);
  // Why that file does not begin as it was at the mark; "" where it does.
  static std::string complaint(const Folder& folder, const Mark& mark);

  bool is_due(const State& state, bool last) const override { return schedule_.is_due(state.n, last); }
  void observe(const State& state, const EnergyReading& energy) override;
  void finish(const RunReport& report) override;
  Mark mark();  // with its rows on the disk

 private:
  void add_ledger(const EnergyReading& energy);

  AtomicFile file_;
  bool has_modified_energy_, has_ledger_;
  Schedule schedule_;
  EnergyReading last_;  // shown
  bool is_first_ = true;
  CsvRow row_;
};

}  // namespace seiche
