// snapshots.csv: t and the physical values of all fields at every due step, one column per value.
#pragma once

#include <seiche/core/observer.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/core/space.hpp>
#include <seiche/output/atomic_file.hpp>
#include <seiche/output/csv_row.hpp>

namespace seiche {

class Snapshots : public Observer {
 public:
  // `space` outlives the observer. With an interval of time > 0 rows stand at its multiples, and `schedule` counts for the
  // first and the last state only.
  Snapshots(const std::filesystem::path& path, const Problem& problem, const Space& space, Schedule schedule,
            double interval = 0.0);

  bool is_due(const State& state, bool last) const override;
  double next_time() const override;
  void observe(const State& state, const EnergyReading& energy) override;
  void finish(const RunReport& report) override;

 private:
  AtomicFile file_;
  const Space& space_;
  Schedule schedule_;
  double interval_;
  std::int64_t shown_ = 0;  // multiples of the interval
  double last_t_ = -std::numeric_limits<double>::infinity();
  Vector values_;
  CsvRow row_;
};

// The columns of a state: u_1 … u_N, v_1 … v_N.
std::vector<std::string> value_names(const Problem& problem);

}  // namespace seiche
