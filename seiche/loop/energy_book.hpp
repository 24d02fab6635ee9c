// The energy books of a run: first and last value, largest increase, and whether the promised law held.
#pragma once

#include <seiche/core/control/archive.hpp>
#include <seiche/core/run_report.hpp>
#include <seiche/core/stepper.hpp>

#include <cstdint>

namespace seiche {

class EnergyBook {
 public:
  EnergyBook(LawPromise promise, bool has_modified_energy);

  // One reading per recorded step, in order. `n` counts steps, so that round-off may add up over those in between.
  void add(const EnergyReading& reading, double t, std::int64_t n);
  bool has(std::int64_t n) const { return !empty_ && n == last_n_; }  // the last reading was taken at step n
  // The next reading starts anew: no increase from the last one to it.
  void reopen() {
    reopened_ = true;
    records_ = 0;
    size_ = 0;
  }
  void write_to(RunReport& report) const;
  void archive(Archive& a);  // but for the promise

 private:
  void take_size(const EnergyReading& reading);
  void judge(double increase, const EnergyReading& reading, double t, double steps);
  void follow(const EnergyReading& reading, double t);
  std::optional<EnergyDrift> drift() const;

  LawPromise promise_;
  bool has_modified_energy_;
  bool empty_ = true;
  bool reopened_ = false;
  bool has_increase_ = false;
  std::int64_t last_n_ = 0;
  int records_ = 0;            // as far as they are counted
  double size_ = 0.0;          // of the terms of the energy that is promised, at the start
  bool rests_ = false;         // all of them were 0 there
  double H_at_start_ = 0.0;    // or behind the last event
  double largest_size_ = 0.0;  // of H, in the whole run
  EnergyDrift rise_, fall_;    // the largest
  EnergyDrift parting_{.is_parting = true};
  EnergyReading last_;
  EnergySummary energy_, modified_;
  struct Violation {
    double t = 0.0, increase = 0.0, round_off = 0.0;
    bool found = false;
    void archive(Archive& a) { a(t, increase, round_off, found); }
  } violation_;  // the first
  struct LostInRoundOff {
    double t = 0.0, round_off = 0.0, size = 0.0;
    bool found = false;
    void archive(Archive& a) { a(t, round_off, size, found); }
  } lost_in_round_off_;  // where that happened first
};

}  // namespace seiche
