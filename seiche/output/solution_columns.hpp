// The data sets of solution.h5: what the file says about itself, the axes, and a column for every number of a time.
#pragma once

#include <seiche/core/run_report.hpp>
#include <seiche/output/hdf5/hdf5.hpp>
#include <seiche/output/solution_layout.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace seiche {

// What the file says about itself, as attributes.
struct SolutionDescription {
  std::vector<std::string> meanings = {};         // of the fields, in their order: "displacement"
  std::map<std::string, std::string> texts = {};  // "equation", "method", "case", …
};

// Where rows lie that solution.h5 only shows: solution/000001.h5, 000002.h5, …, beside it.
inline constexpr const char* segments_folder = "solution";
std::string segment_name(std::size_t number);  // "000001.h5" of 1

// The rows of all fields lie in this file, under the names of the fields; "": in this one, in a group of its own.
struct RowsOfFields {
  std::string file;
  std::uint64_t rows = 0;
};
inline constexpr const char* rest_group = "rest";

// All but the rows and the end, in a new file. Returns the columns: the fields, H, H_modified if there is one, and t.
// With `parts` the fields are virtual and have all their rows; those of the group are left to be made.
std::vector<Hdf5Dataset> make_columns(Hdf5File& file, const SolutionLayout& layout,
                                      const SolutionDescription& description, bool has_modified_energy,
                                      const std::vector<RowsOfFields>& parts = {});
// What a solution has once, and its segments need not have: where its points and bars are, and how the run ended.
void write_end(Hdf5File& file, const SolutionLayout& layout, const RunReport& report);

}  // namespace seiche
