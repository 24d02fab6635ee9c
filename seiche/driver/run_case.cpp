#include <seiche/core/base/error.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/driver/case_run.hpp>
#include <seiche/driver/run_case.hpp>
#include <seiche/loop/time_grid.hpp>

#include <utility>

namespace seiche {

CaseResult run_case(RunSpec spec, const std::filesystem::path& folder, const RunCaseOptions& options) {
  spec.output_directory = folder.string();
  if (!spec.tolerance) TimeGrid(spec.t_start, spec.h, spec.t_end);
  // A run repeated in its folder plans its transforms the same way.
  if (spec.measure_plans) use_planning_wisdom(text_of_file(folder / CaseRun::wisdom_name));
  const Problem problem = make_problem(spec);
  settle_snapshots(spec, problem);
  return CaseRun(std::move(spec), problem, options).result();
}

CaseResult resume_case(GoingOn from, const RunCaseOptions& options) {
  if (from.spec.measure_plans) use_planning_wisdom(text_of_file(from.folder->folder().path() / CaseRun::wisdom_name));
  const Problem problem = make_problem(from.spec);
  return CaseRun(from.spec, problem, options, &from).result();
}

}  // namespace seiche
