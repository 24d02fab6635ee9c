#include <seiche/config/case/case_file.hpp>
#include <seiche/core/error.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/driver/case_run.hpp>
#include <seiche/driver/run_case.hpp>
#include <seiche/run/time_grid.hpp>

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace seiche {
namespace {

namespace fs = std::filesystem;

// Throws Error where the steps of the case do not lead to its end.
void require_time_grid(const RunSpec& spec) {
  if (!spec.tolerance) TimeGrid(spec.t_start, spec.h, spec.t_end);
}

// The case of a checkpoint with another end, read as a case file with that end is.
RunSpec with_end(RunSpec spec, double t_end, const SavedRun& saved, const fs::path& folder) {
  if (!std::isfinite(t_end) || t_end < saved.t)
    throw Error("the run cannot end at t = {:.9g}: that must be a finite time, and the checkpoint is at t = {:.9g}",
                t_end, saved.t);
  spec.t_end = t_end;
  RunSpec read = parse_case(write_case(spec), fmt::format("the case with end = {:.9g}", t_end), {}, folder);
  read.output_directory = spec.output_directory;
  return read;
}

}  // namespace

CaseResult run_case(RunSpec spec, const fs::path& folder, const RunCaseOptions& options) {
  spec.output_directory = folder.string();
  require_time_grid(spec);
  // A run repeated in its folder plans its transforms the same way.
  if (spec.measure_plans) use_planning_wisdom(text_of_file(folder / CaseRun::wisdom_name));
  const Problem problem = make_problem(spec);
  settle_snapshots(spec, problem);
  return CaseRun(std::move(spec), problem, options).result();
}

CaseResult resume_case(const fs::path& folder, std::optional<double> t_end, const RunCaseOptions& options) {
  CaseFolder case_folder(folder);
  std::vector<std::string> notes;
  GoingOn from{.folder = case_folder, .from = newest_checkpoint(case_folder.folder(), notes)};
  SavedRun& saved = from.from.run;
  RunSpec spec = parse_case(saved.case_text, from.from.name, {}, folder);
  spec.output_directory = folder.string();
  if (t_end && *t_end != spec.t_end) {
    spec = with_end(std::move(spec), *t_end, saved, folder);
    from.new_end = t_end;
  }
  require_time_grid(spec);
  saved.notes.insert(saved.notes.end(), notes.begin(), notes.end());
  if (options.warn)
    for (const std::string& note : notes) options.warn(note);
  if (options.ends_at) options.ends_at(spec.t_end);
  if (spec.measure_plans) use_planning_wisdom(text_of_file(folder / CaseRun::wisdom_name));
  const Problem problem = make_problem(spec);
  return CaseRun(std::move(spec), problem, options, &from).result();
}

}  // namespace seiche
