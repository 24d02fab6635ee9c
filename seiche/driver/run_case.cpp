#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/driver/case_run.hpp>
#include <seiche/driver/run_case.hpp>
#include <seiche/loop/time_grid.hpp>

#include <optional>
#include <utility>

namespace seiche {
namespace {

// What follow_case asks for.
void tell_others(const RunSpec& spec, const std::string& checkpoint, const RunCaseOptions& options) {
  if (options.ranks == nullptr) return;
  options.ranks->from_first(std::filesystem::absolute(spec.output_directory).string());
  options.ranks->from_first(checkpoint);
  options.ranks->from_first(write_case(spec));
}

}  // namespace

CaseResult run_case(RunSpec spec, const std::filesystem::path& folder, const RunCaseOptions& options) {
  std::optional<Problem> problem;
  on_first(options.ranks, [&] {
    spec.output_directory = folder.string();
    if (!spec.tolerance) TimeGrid(spec.t_start, spec.h, spec.t_end);
    // A run repeated in its folder plans its transforms the same way.
    if (spec.measure_plans) use_planning_wisdom(text_of_file(folder / CaseRun::wisdom_name));
    problem = problem_here(spec, options);
    settle_snapshots(spec, *problem);
  });
  tell_others(spec, "", options);
  return CaseRun(std::move(spec), *problem, options).result();
}

CaseResult resume_case(GoingOn from, const RunCaseOptions& options) {
  std::optional<Problem> problem;
  on_first(options.ranks, [&] {
    if (from.spec.measure_plans) use_planning_wisdom(text_of_file(from.folder->folder().path() / CaseRun::wisdom_name));
    problem = problem_here(from.spec, options);
  });
  tell_others(from.spec, from.from.name, options);
  return CaseRun(from.spec, *problem, options, &from).result();
}

}  // namespace seiche
