// solution.h5.partial, while rows are written to it.
#pragma once

#include <seiche/core/run_report.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/hdf5/hdf5.hpp>
#include <seiche/output/solution_columns.hpp>
#include <seiche/output/solution_layout.hpp>

#include <cstdint>
#include <vector>

namespace seiche {

inline constexpr const char* solution_name = "solution.h5";

struct OpenSolution {
  PartialPath path;
  Hdf5File file;
  std::vector<Hdf5Dataset> columns;  // the fields, H, H_modified if there is one, and t
  std::uint64_t rows = 0;

  // `parts`: as of make_columns.
  OpenSolution(const Folder& folder, const SolutionLayout& layout, const SolutionDescription& description,
               bool has_modified_energy, const std::vector<RowsOfFields>& parts = {});
  void close();                                                     // the file, which can be read then
  void commit(const SolutionLayout& layout, const RunReport& end);  // it is solution.h5
};

}  // namespace seiche
