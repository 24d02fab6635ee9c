#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/driver/case_run.hpp>
#include <seiche/driver/run_case.hpp>
#include <seiche/loop/time_grid.hpp>

#include <utility>

namespace seiche {
namespace {

// A run repeated in its folder plans its transforms the same way.
void use_wisdom(const RunSpec& spec, const std::filesystem::path& folder, const RunCaseOptions& options) {
  if (!spec.measure_plans) return;
  if (options.ranks != nullptr)
    throw Error(
        "plan = \"measure\" is for one process: several would each find plans of their own; write \"estimate\"");
  use_planning_wisdom(text_of_file(folder / CaseRun::wisdom_name));
}

// What follow_case asks for.
void tell_others(const RunSpec& spec, const std::string& checkpoint, const RunCaseOptions& options) {
  if (options.ranks == nullptr) return;
  options.ranks->from_first(std::filesystem::absolute(spec.output_directory).string());
  options.ranks->from_first(checkpoint);
  options.ranks->from_first(write_case(spec));
  options.ranks->together([] {});  // the others read it
}

}  // namespace

CaseResult run_case(RunSpec spec, const std::filesystem::path& folder, const RunCaseOptions& options) {
  on_first(options.ranks, [&] {
    spec.output_directory = folder.string();
    if (!spec.tolerance) TimeGrid(spec.t_start, spec.h, spec.t_end);
    use_wisdom(spec, folder, options);
  });
  tell_others(spec, "", options);
  const Problem problem = problem_here(spec, options);
  settle_snapshots(spec, problem);
  return CaseRun(std::move(spec), problem, options).result();
}

CaseResult resume_case(GoingOn from, const RunCaseOptions& options) {
  on_first(options.ranks, [&] { use_wisdom(from.spec, from.folder->folder().path(), options); });
  tell_others(from.spec, from.from.name, options);
  const Problem problem = problem_here(from.spec, options);
  return CaseRun(from.spec, problem, options, &from).result();
}

}  // namespace seiche
