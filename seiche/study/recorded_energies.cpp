#include <seiche/output/csv_table.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/study/recorded_energies.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace seiche {
namespace {

class Increase {
 public:
  void add(double value) {
    const double increase = value - last_;
    if (readings_ == 1) largest_ = increase;
    if (readings_ > 1 && !std::isnan(largest_))
      largest_ = std::isnan(increase) ? increase : std::max(largest_, increase);
    last_ = value;
    readings_ = std::min(readings_ + 1, 2);
  }
  double largest() const { return largest_; }

 private:
  double last_ = 0.0, largest_ = 0.0;
  int readings_ = 0;  // as far as they matter
};

struct States {
  std::vector<double> times, H, modified;
  bool all = true;
};

States judged_states(const std::filesystem::path& file, const RunSpec& spec) {
  if (!std::filesystem::exists(file) || spec.snapshot_interval > 0) return {};
  const SolutionReader solution(file);
  return {.times = solution.times(),
          .H = solution.energies(),
          .modified = solution.modified_energies(),
          .all = solution.text("status") != "unfinished"};
}

}  // namespace

LargestIncreases largest_increases(const std::filesystem::path& directory, const RunSpec& spec) {
  const States states = judged_states(directory / "solution.h5", spec);
  CsvReader rows(directory / "energy.csv");
  const bool has_modified =
      rows.names().size() > 2 && rows.names()[2] == "H_modified" && (states.times.empty() || !states.modified.empty());
  Increase H, modified;
  std::size_t next = 0;  // state
  for (std::vector<double> row; rows.next(row);) {
    for (; next < states.times.size() && states.times[next] < row[0]; ++next) {
      H.add(states.H[next]);
      if (has_modified) modified.add(states.modified[next]);
    }
    if (next < states.times.size() && states.times[next] == row[0]) ++next;
    H.add(row[1]);
    if (has_modified) modified.add(row[2]);
  }
  // With a tolerance a run judges every step.
  return {.H = H.largest(),
          .modified = modified.largest(),
          .of_all = states.all && (!spec.tolerance || spec.energy_every == 1)};
}

}  // namespace seiche
