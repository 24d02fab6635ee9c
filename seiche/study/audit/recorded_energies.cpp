#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/study/audit/recorded_energies.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
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
};

States judged_states(const std::filesystem::path& file, const RunSpec& spec) {
  if (!std::filesystem::exists(file) || spec.snapshot_interval > 0) return {};
  const SolutionReader solution(file);
  return {.times = solution.times(), .H = solution.energies(), .modified = solution.modified_energies()};
}

}  // namespace

std::optional<std::size_t> find_column(const CsvReader& table, std::string_view name) {
  const auto found = std::find(table.names().begin(), table.names().end(), name);
  if (found == table.names().end()) return {};
  return static_cast<std::size_t>(found - table.names().begin());
}

std::size_t column_of(const CsvReader& table, std::string_view name, const std::filesystem::path& file) {
  if (const std::optional<std::size_t> found = find_column(table, name)) return *found;
  throw Error("{} has no column {}: its columns are {}", file.string(), name,
              shortened(fmt::format("{}", fmt::join(table.names(), ", ")), 200));
}

LargestIncreases largest_increases(const std::filesystem::path& directory, const RunSpec& spec) {
  const States states = judged_states(directory / "solution.h5", spec);
  const std::filesystem::path file = directory / "energy.csv";
  CsvReader rows(file);
  const std::size_t in_t = column_of(rows, "t", file), in_H = column_of(rows, "H", file);
  const std::optional<std::size_t> in_modified = find_column(rows, "H_modified");
  const bool has_modified = in_modified && (states.times.empty() || !states.modified.empty());
  Increase H, modified;
  std::size_t next = 0;  // state
  for (std::vector<double> row; rows.next(row);) {
    for (; next < states.times.size() && states.times[next] < row[in_t]; ++next) {
      H.add(states.H[next]);
      if (has_modified) modified.add(states.modified[next]);
    }
    if (next < states.times.size() && states.times[next] == row[in_t]) ++next;
    H.add(row[in_H]);
    if (has_modified) modified.add(row[*in_modified]);
  }
  // With a tolerance a run judges every step.
  return {.H = H.largest(),
          .modified = has_modified ? modified.largest() : std::numeric_limits<double>::quiet_NaN(),
          .of_all = !spec.tolerance || spec.energy_every == 1};
}

}  // namespace seiche
