#include <seiche/record/open_solution.hpp>

namespace seiche {

OpenSolution::OpenSolution(const Folder& folder, const SolutionLayout& layout, const SolutionDescription& description,
                           bool has_modified_energy, const std::vector<RowsOfFields>& parts)
    : path(folder, solution_name),
      file(Hdf5File::create(path.open(), path.temporary())),
      columns(make_columns(file, layout, description, has_modified_energy, parts)) {}

void OpenSolution::close() {
  columns.clear();
  file.close();
}

void OpenSolution::commit(const SolutionLayout& layout, const RunReport& end) {
  write_end(file, layout, end);
  close();
  path.commit();
}

}  // namespace seiche
