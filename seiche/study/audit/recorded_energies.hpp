// The energies that a run has judged, read back from its files.
#pragma once

#include <seiche/config/case/run_spec.hpp>
#include <seiche/output/csv_table.hpp>

#include <filesystem>
#include <limits>
#include <optional>
#include <string_view>

namespace seiche {

// Where a table has a column; nothing where it has none of that name.
std::optional<std::size_t> find_column(const CsvReader& table, std::string_view name);
// Throws Error, with the file and the columns that it has, where it has none of that name.
std::size_t column_of(const CsvReader& table, std::string_view name, const std::filesystem::path& file);

// From one reading to the next: the largest increase, 0 of fewer than two readings, and NaN where one is NaN. Without
// a modified energy in the files that of it is NaN.
struct LargestIncreases {
  double H = 0.0, modified = std::numeric_limits<double>::quiet_NaN();
  bool of_all = true;  // every reading of the run is in its files; else each increase is that of several steps
};

// Over the rows of energy.csv and the states of solution.h5 together, in the order of their times, up to the last row
// of energy.csv: a run judges its energy wherever one of the two is due. States between two steps, at multiples of
// output.snapshot_interval, are not among them. Throws Error where a file cannot be read, or energy.csv has
// no t or no H.
LargestIncreases largest_increases(const std::filesystem::path& directory, const RunSpec& spec);

}  // namespace seiche
