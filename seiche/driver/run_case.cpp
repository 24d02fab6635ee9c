#include <seiche/config/case/case_file.hpp>
#include <seiche/core/error.hpp>
#include <seiche/driver/case_run.hpp>
#include <seiche/driver/run_case.hpp>

#include <fstream>
#include <iterator>
#include <utility>

namespace seiche {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

CaseResult run_case(RunSpec spec, const fs::path& folder, const RunCaseOptions& options) {
  spec.output_directory = folder.string();
  // A run repeated in its folder plans its transforms the same way.
  if (spec.measure_plans) use_planning_wisdom(text_of(folder / CaseRun::wisdom_name));
  const Problem problem = make_problem(spec);
  settle_snapshots(spec, problem);
  return CaseRun(std::move(spec), problem, options).result();
}

CaseResult resume_case(const fs::path& folder, std::optional<double> t_end, const RunCaseOptions& options) {
  CaseFolder case_folder(folder);
  std::vector<std::string> notes;
  Checkpoint from = newest_checkpoint(case_folder.folder(), notes);
  from.run.notes.insert(from.run.notes.end(), notes.begin(), notes.end());
  if (options.warn)
    for (const std::string& note : notes) options.warn(note);
  RunSpec spec = parse_case(from.run.case_text, from.name, {}, folder);
  spec.output_directory = folder.string();
  if (t_end) spec.t_end = *t_end;
  if (spec.t_end < from.run.t)
    throw Error("t = {:.9g} is before the checkpoint, which is at t = {:.9g}", spec.t_end, from.run.t);
  if (t_end) {  // a case of its own from here on
    from.run.case_text = write_case(spec);
    from.run.hashes["case.toml"] = sha256(from.run.case_text);
    write_file(case_folder.folder(), "case.toml", from.run.case_text);
  }
  if (spec.measure_plans) use_planning_wisdom(text_of(folder / CaseRun::wisdom_name));
  const Problem problem = make_problem(spec);
  return CaseRun(std::move(spec), problem, options, &case_folder, &from).result();
}

}  // namespace seiche
