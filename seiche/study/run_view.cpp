#include <seiche/backend/backends.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/output/file/temporary_folder.hpp>
#include <seiche/problem/problems.hpp>
#include <seiche/record/whole_solution.hpp>
#include <seiche/study/run_view.hpp>
#include <seiche/study/unfinished_run.hpp>

#include <cmath>
#include <memory>
#include <system_error>

namespace seiche {
namespace {

namespace fs = std::filesystem;

// Links keep the segments where the run ends meanwhile; where none can be made, copies do.
void keep_segments(const SegmentsMark& mark, const fs::path& from, const fs::path& to) {
  if (mark.sealed.empty()) return;
  fs::create_directory(to);
  for (std::size_t k = 1; k <= mark.sealed.size(); ++k) {
    std::error_code failure;
    fs::create_hard_link(from / segment_name(k), to / segment_name(k), failure);
    if (failure) fs::copy_file(from / segment_name(k), to / segment_name(k), failure);
    if (failure) throw Error("{} cannot be read: {}", (from / segment_name(k)).string(), failure.message());
  }
}

// In a folder that goes with the run.
void show_solution(const UnfinishedRun& unfinished, const Problem& problem, RunFiles& run) {
  const auto folder = std::make_shared<TemporaryFolder>(run.directory);
  const ProblemEntry& entry = problem_entry(unfinished.spec);
  RunReport report;
  report.status = RunReport::Status::interrupted;
  report.message = run.message;
  const SegmentsMark& rows = unfinished.saved.solution->rows;
  keep_segments(rows, run.directory / segments_folder, folder->path() / segments_folder);
  show_segments(Folder(folder->path()), solution_layout(problem),
                {.meanings = entry.meanings, .texts = {{"title", run_name(run)}, {"equation", entry.equation}}}, rows,
                report);
  run.solution = folder->path() / solution_name;
  run.temporary = folder;
}

RunView view_of(const UnfinishedRun& unfinished, const fs::path& directory) {
  const SavedRun& saved = unfinished.saved;
  RunView view{.run = run_of_case(directory, unfinished.spec, saved.case_text),
               .history = read_energy_history(unfinished.energies, saved.energies.file.length)};
  RunFiles& run = view.run;
  if (!saved.solution) throw Error("{} holds an ensemble, which leaves statistics and no solution", directory.string());
  run.status = run.message = unfinished.how_far();
  run.has_ended = false;
  run.is_running = unfinished.is_running;
  run.problem = unfinished.spec.problem;
  run.method = unfinished.spec.method;
  run.steps = saved.steps;
  run.t = saved.t;
  const auto numbers = [](const Curve& curve) {
    return curve.value.empty() ? EnergyNumbers{std::nan(""), std::nan(""), std::nan("")}
                               : EnergyNumbers{curve.value.front(), curve.value.back(), std::nan("")};
  };
  run.energy = numbers(view.history.H);
  if (view.history.modified) run.modified = numbers(*view.history.modified);
  run.wall_seconds = std::nan("");
  const Problem problem = make_problem(unfinished.spec);
  run.backend = unfinished.spec.backend;
  if (run.backend == "auto") run.backend = automatic_backend(problem).name;
  show_solution(unfinished, problem, run);
  return view;
}

}  // namespace

RunView view_of_run(const fs::path& directory) {
  if (const std::optional<UnfinishedRun> unfinished = unfinished_run(directory)) return view_of(*unfinished, directory);
  return {.run = read_run(directory), .history = read_energy_history(directory / "energy.csv")};
}

void require_still_unfinished(const RunFiles& run) {
  if (!run.has_ended && fs::exists(run.directory / "summary.json"))
    throw Error("the run in {} ended while it was looked at: look at it again", run.directory.string());
}

}  // namespace seiche
