#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/driver/going_on.hpp>
#include <seiche/loop/time_grid.hpp>

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace seiche {
namespace {

// The case of a checkpoint with another end, read as a case file with that end is.
RunSpec with_end(RunSpec spec, double t_end, const SavedRun& saved, const std::filesystem::path& folder) {
  if (!std::isfinite(t_end) || t_end < saved.t)
    throw Error("the run cannot end at t = {:.9g}: that must be a finite time, and the checkpoint is at t = {:.9g}",
                t_end, saved.t);
  spec.t_end = t_end;
  RunSpec read = parse_case(write_case(spec), fmt::format("the case with end = {:.9g}", t_end), {}, folder);
  read.output_directory = spec.output_directory;
  return read;
}

}  // namespace

GoingOn going_on(const std::filesystem::path& folder, std::optional<double> t_end, const RunCaseOptions& options) {
  auto case_folder = std::make_unique<CaseFolder>(folder);
  std::vector<std::string> notes;
  Checkpoint newest = newest_checkpoint(case_folder->folder(), notes);
  GoingOn on{.folder = std::move(case_folder), .from = std::move(newest), .spec = {}};
  SavedRun& saved = on.from.run;
  require_case(folder, saved);
  on.spec = parse_case(saved.case_text, on.from.name, {}, folder);
  on.spec.output_directory = folder.string();
  if (t_end && *t_end != on.spec.t_end) {
    on.spec = with_end(std::move(on.spec), *t_end, saved, folder);
    on.new_end = t_end;
  }
  if (!on.spec.tolerance) TimeGrid(on.spec.t_start, on.spec.h, on.spec.t_end);
  saved.notes.insert(saved.notes.end(), notes.begin(), notes.end());
  if (options.warn)
    for (const std::string& note : notes) options.warn(note);
  if (options.ends_at) options.ends_at(on.spec.t_end);
  return on;
}

}  // namespace seiche
