// The energies that a run has judged, read back from its files.
#pragma once

#include <seiche/config/case/run_spec.hpp>

#include <filesystem>

namespace seiche {

// From one reading to the next: the largest increase, 0 of fewer than two readings, and NaN where one is NaN.
struct LargestIncreases {
  double H = 0.0, modified = 0.0;
  bool of_all = true;  // every reading of the run is in its files; else each increase is that of several steps
};

// Over the rows of energy.csv and the states of solution.h5 together, in the order of their times, up to the last row
// of energy.csv: a run judges its energy wherever one of the two is due. States between two steps, at multiples of
// output.snapshot_interval, are not among them. Throws Error where a file cannot be read.
LargestIncreases largest_increases(const std::filesystem::path& directory, const RunSpec& spec);

}  // namespace seiche
