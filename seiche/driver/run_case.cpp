#include <seiche/config/case/case_file.hpp>
#include <seiche/core/error.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/driver/case_run.hpp>
#include <seiche/driver/run_case.hpp>

#include <fmt/format.h>

#include <utility>

namespace seiche {
namespace {

namespace fs = std::filesystem;

constexpr const char *case_name = "case.toml", *other_case_name = "case_before_resume.toml";

// What others did to case.toml is kept, and does not count.
void restore_case(const Folder& folder, const std::string& text, std::vector<std::string>& notes) {
  const fs::path path = folder.path() / case_name;
  if (text_of_file(path) == text) return;
  const bool is_there = look_at(path).kind != InputKind::missing;
  if (is_there) rename_file(folder, case_name, other_case_name);
  notes.push_back(is_there ? fmt::format("{} was not that of the checkpoint, which counts: it is {} now", case_name,
                                         other_case_name)
                           : fmt::format("{} was missing: it is that of the checkpoint again", case_name));
  write_file(folder, case_name, text);
}

}  // namespace

CaseResult run_case(RunSpec spec, const fs::path& folder, const RunCaseOptions& options) {
  spec.output_directory = folder.string();
  // A run repeated in its folder plans its transforms the same way.
  if (spec.measure_plans) use_planning_wisdom(text_of_file(folder / CaseRun::wisdom_name));
  const Problem problem = make_problem(spec);
  settle_snapshots(spec, problem);
  return CaseRun(std::move(spec), problem, options).result();
}

CaseResult resume_case(const fs::path& folder, std::optional<double> t_end, const RunCaseOptions& options) {
  CaseFolder case_folder(folder);
  std::vector<std::string> notes;
  Checkpoint from = newest_checkpoint(case_folder.folder(), notes);
  RunSpec spec = parse_case(from.run.case_text, from.name, {}, folder);
  spec.output_directory = folder.string();
  if (t_end) spec.t_end = *t_end;
  if (spec.t_end < from.run.t)
    throw Error("t = {:.9g} is before the checkpoint, which is at t = {:.9g}", spec.t_end, from.run.t);
  restore_case(case_folder.folder(), from.run.case_text, notes);
  from.run.notes.insert(from.run.notes.end(), notes.begin(), notes.end());
  if (options.warn)
    for (const std::string& note : notes) options.warn(note);
  if (options.ends_at) options.ends_at(spec.t_end);
  if (t_end) {  // a case of its own from here on
    from.run.case_text = write_case(spec);
    from.run.hashes["case.toml"] = sha256(from.run.case_text);
    write_file(case_folder.folder(), case_name, from.run.case_text);
  }
  if (spec.measure_plans) use_planning_wisdom(text_of_file(folder / CaseRun::wisdom_name));
  const Problem problem = make_problem(spec);
  return CaseRun(std::move(spec), problem, options, &case_folder, &from).result();
}

}  // namespace seiche
