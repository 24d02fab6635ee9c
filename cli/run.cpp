// seiche run: one case, one method, and the files that a run leaves.
#include "command_line.hpp"
#include "load_case.hpp"
#include "stop_signal.hpp"
#include "versions.hpp"

#include <fmt/format.h>
#include <seiche/core/error.hpp>
#include <seiche/driver/run_case.hpp>
#include <seiche/driver/run_ensemble_case.hpp>
#include <seiche/output/progress.hpp>
#include <seiche/output/solution_file.hpp>

#include <memory>
#include <utility>

namespace seiche::cli {
namespace {

struct RunArguments {
  CaseArgument case_argument;
  std::string directory;
  bool directory_given = false;
  int threads = 1;
  bool restart = false;
  bool json = false;
  bool quiet = false;
};

ExitCode exit_code(RunReport::Status status, bool is_law_violated) {
  switch (status) {
    case RunReport::Status::failed: return computation_failed;
    case RunReport::Status::interrupted: return interrupted;
    case RunReport::Status::success: break;
  }
  return is_law_violated ? law_violated : success;
}

RunCaseOptions run_options(const RunArguments& arguments) {
  return {.threads = arguments.threads,
          .restart = arguments.restart,
          .begins =
              [quiet = arguments.quiet](const std::vector<std::string>& notes) {
                const std::atomic<bool>& stop = stop_on_signal();  // until here, a signal simply ends the program
                if (!quiet) print_notes(notes);
                return &stop;
              },
          .ends = [] { return &hold_signals(); },
          .warn = [](const std::string& note) { print_note(note); },
          .versions = versions()};
}

void print(const RunArguments& arguments, const RunSpec& spec, const CaseResult& result) {
  const RunReport& report = result.report;
  if (arguments.json) print_data(result.summary);
  if (!arguments.quiet) {
    print_lines(report.full());  // the notes stand above it already
    if (!result.certificate.theorem.empty())
      print_lines(fmt::format("{:<10} {}\n", "theorem", result.certificate.theorem));
    print_lines(fmt::format("{:<10} {}\n", "files", spec.output_directory));
    // Again, where a reader's eye ends.
    if (report.drift) print_note(fmt::format("{}, and what came out may be inaccurate", report.drift->text()));
    if (report.replaced.count > 0)
      print_note(fmt::format("{} of {} steps {} replaced, and what followed may be inaccurate", report.replaced.count,
                             report.steps, report.replaced.count == 1 ? "was" : "were"));
  } else if (report.status == RunReport::Status::failed || report.law == LawVerdict::violated ||
             !report.remarks().empty()) {
    print_note(result.message);
  } else if (!result.feeds.empty()) {
    // mostly a sign typed wrong; of friction it may be the point
    print_note(fmt::format("{}: it feeds energy, and no energy law is promised", result.feeds));
  }
}

void print(const RunArguments& arguments, const RunSpec& spec, const EnsembleCaseResult& result) {
  const EnsembleOutcome& outcome = result.outcome;
  if (arguments.json) print_data(result.summary);
  if (!arguments.quiet) {
    print_lines(fmt::format("{}: {}\n", to_string(outcome.status()), outcome.message));
    print_lines(fmt::format("{:<10} mean {:.9g} → {:.9g}\n{:<10} {} members in {:.3g} s\n{:<10} {}\n", "H",
                            result.first.H.mean, result.last.H.mean, "time", result.members, result.wall_seconds,
                            "files", spec.output_directory));
  } else if (outcome.is_remarkable()) {
    print_note(outcome.message);
  }
}

ExitCode run_ensemble(const RunArguments& arguments, const RunSpec& spec) {
  try {
    const EnsembleCaseResult result = run_ensemble_case(spec, spec.output_directory, run_options(arguments));
    print(arguments, spec, result);
    return exit_code(result.outcome.status(), result.outcome.violated > 0);
  } catch (const Error& error) {
    if (!has_stopped()) throw;
    print_note(error.what());  // a signal came before the members were set up
    return interrupted;
  }
}

ExitCode run(const RunArguments& arguments) {
  hdf5_without_cleanup_at_exit();
  RunSpec spec = load_case(arguments.case_argument);
  if (arguments.directory_given && arguments.directory.empty()) throw Error("--out must not be empty");
  if (arguments.directory_given) spec.output_directory = arguments.directory;
  if (spec.ensemble) return run_ensemble(arguments, spec);
  RunCaseOptions options = run_options(arguments);
  Progress progress(stderr, spec.t_end);
  if (ProgressBar::is_wanted(arguments.quiet)) options.observers.push_back(&progress);
  const CaseResult result = run_case(spec, spec.output_directory, options);
  print(arguments, spec, result);
  return exit_code(result.report.status, result.report.law == LawVerdict::violated);
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command =
      app.add_subcommand("run", "Run one case; its report goes to stderr, with --json its summary to stdout");
  add_case(*command, arguments->case_argument);
  CLI::Option* out =
      command->add_option("--out", arguments->directory, "Where the files go, instead of output.directory")
          ->type_name("DIR");
  command
      ->add_option("--threads", arguments->threads,
                   "Threads, over a large grid or the members of an ensemble; results do not depend on it")
      ->type_name("N")
      ->check(CLI::Range(1, 65536));
  command->add_flag("--restart", arguments->restart,
                    "Begin anew where the folder holds a run that did not finish, which is removed");
  command->add_flag("--json", arguments->json, "Print summary.json on stdout");
  command->add_flag("--quiet", arguments->quiet, "No progress bar, and a word only when something went wrong");
  command->callback([arguments, out, &action] {
    arguments->directory_given = out->count() > 0;
    action = [arguments] { return run(*arguments); };
  });
}

}  // namespace seiche::cli
