// seiche recover: what the checkpoint of a run that was killed vouches for, as files that can be read.
#include "command_line.hpp"
#include "stop_signal.hpp"
#include "versions.hpp"

#include <fmt/format.h>
#include <seiche/core/base/error.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/driver/going_on.hpp>
#include <seiche/driver/run_ensemble_case.hpp>
#include <seiche/output/hdf5/hdf5.hpp>
#include <seiche/record/run_folder.hpp>

#include <filesystem>
#include <memory>
#include <string>

namespace seiche::cli {
namespace {

// Behind a run that was killed when all its files were there, before it had removed what it needs no longer.
void tidy_up(const std::filesystem::path& path) {
  const CaseFolder folder(path);
  remove_partial_files(folder.folder());
  if (holds_joined_solution(path)) remove_segments(folder.folder());
}

// Its end, without the run.
ExitCode recover_run(const std::string& directory) {
  const std::filesystem::path path = directory;
  if (look_at(path / "case.toml").kind == InputKind::missing && checkpoints_in(path).empty())
    throw Error("{} holds no run: there is no case.toml in it", directory);
  const bool has_checkpoint = !checkpoints_in(path).empty(), complete = is_complete(path);
  if (complete || (!has_checkpoint && look_at(path / "summary.json").kind != InputKind::missing)) {
    if (complete && !has_checkpoint) tidy_up(path);
    print_note(fmt::format("{} holds no unfinished files: there is nothing to recover", directory));
    return success;
  }
  answer_signals("stopped before the files were written; what the checkpoint vouches for is as it was");
  hdf5_without_cleanup_at_exit();
  const RunCaseOptions options{.stops_at_once = true,
                               .begins = [] { return &stop_on_signal(); },
                               .warn = [](const std::string& note) { print_note(note); },
                               .versions = versions()};
  GoingOn from = going_on(path, {}, options);
  const double t = from.from.run.t;
  RunReport::Status status = RunReport::Status::interrupted;
  std::string message;
  if (from.spec.ensemble) {
    const EnsembleCaseResult result = resume_ensemble_case(std::move(from), options);
    status = result.outcome.status();
    message = result.outcome.message;
  } else {
    const CaseResult result = resume_case(std::move(from), options);
    status = result.report.status;
    message = result.message;
  }
  if (status != RunReport::Status::failed)
    print_lines(fmt::format("{:<10} {}, up to t = {:.9g}\n", "saved", directory, t));
  print_lines(fmt::format("{}: {}\n", to_string(status), message));
  return status == RunReport::Status::failed ? computation_failed : success;
}

}  // namespace

void add_recover(CLI::App& app, Action& action) {
  auto directory = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "recover", "Make readable what a run that was killed has left, up to its newest checkpoint, without going on");
  command->add_option("DIR", *directory, "The directory that the run left")->required()->type_name("");
  command->callback([directory, &action] { action = [directory] { return recover_run(*directory); }; });
}

}  // namespace seiche::cli
