// seiche run: one case, one method, and the files that a run leaves. seiche resume: the same from a checkpoint.
#include "command_line.hpp"
#include "load_case.hpp"
#include "processes.hpp"
#include "stop_signal.hpp"
#include "versions.hpp"

#include <fmt/format.h>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/simd/thread_count.hpp>
#include <seiche/driver/follow_case.hpp>
#include <seiche/driver/going_on.hpp>
#include <seiche/driver/run_ensemble_case.hpp>
#include <seiche/output/hdf5/hdf5.hpp>
#include <seiche/output/progress.hpp>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace seiche::cli {
namespace {

// Of both commands.
struct RunArguments {
  std::string directory;
  int threads = 1;
  double max_hours = 0;
  bool restart = false;
  bool json = false;
  bool quiet = false;
  bool verbose = false;
};

struct NewRunArguments : RunArguments {
  CaseArgument case_argument;
  bool directory_given = false;
};

struct ResumeArguments : RunArguments {
  std::optional<double> until;
};

ExitCode exit_code(RunReport::Status status, bool is_law_violated) {
  switch (status) {
    case RunReport::Status::failed: return computation_failed;
    case RunReport::Status::interrupted: return interrupted;
    case RunReport::Status::success: break;
  }
  return is_law_violated ? law_violated : success;
}

RunCaseOptions run_options(const RunArguments& arguments, const Ranks* ranks) {
  return {.threads = arguments.threads,
          .restart = arguments.restart,
          .max_hours = arguments.max_hours,
          .save = &save_on_signal(),
          .begins = [] { return &stop_on_signal(); },
          .introduce =
              [quiet = arguments.quiet](const std::string& headline, const std::vector<std::string>& notes) {
                if (quiet) return;
                print_lines(headline + "\n");
                print_notes(notes);
              },
          .ends = [] { return &hold_signals(); },
          .warn = [](const std::string& note) { print_note(note); },
          .versions = versions(),
          .ranks = ranks};
}

void require_single_run(const RunSpec& spec, const Ranks* ranks) {
  if (spec.ensemble && ranks != nullptr)
    throw Error("an ensemble runs on the threads of one process (--threads), and {} processes were started",
                ranks->here().count);
}

// What processes do that are not the first, for either command.
ExitCode follow(const RunArguments& arguments, const Ranks& ranks) {
  answer_signals("");     // the first one says it
  ranks.on_first([] {});  // reads the case, or the checkpoint
  const CaseResult result =
      follow_case({.threads = arguments.threads, .begins = [] { return &stop_on_signal(); }, .ranks = &ranks});
  hold_signals();
  return exit_code(result.report.status, result.report.law == LawVerdict::violated);
}

void print(const RunArguments& arguments, const std::string& directory, const CaseResult& result) {
  const RunReport& report = result.report;
  if (arguments.json) print_data(result.summary);
  if (!arguments.quiet) {
    print_lines(report.full());  // the notes stand above it already
    if (arguments.verbose) print_lines(report.work());
    if (arguments.verbose && !result.certificate.theorem.empty())
      print_lines(fmt::format("{:<10} {}\n", "theorem", result.certificate.theorem));
    print_lines(fmt::format("{:<10} {}\n", "files", directory));
    if (result.xdmf_every > 1)
      print_lines(
          fmt::format("{:<10} one time in {}, so that the file stays small: `seiche plot {} --xdmf` shows all\n",
                      "ParaView", result.xdmf_every, directory));
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

void print(const RunArguments& arguments, const std::string& directory, const EnsembleCaseResult& result) {
  const EnsembleOutcome& outcome = result.outcome;
  if (arguments.json) print_data(result.summary);
  if (!arguments.quiet) {
    print_lines(fmt::format("{}: {}\n", to_string(outcome.status()), outcome.message));
    print_lines(fmt::format("{:<10} mean {:.9g} → {:.9g}\n{:<10} {} members in {:.3g} s\n{:<10} {}\n", "H",
                            result.first.H.mean, result.last.H.mean, "time", result.members, result.wall_seconds,
                            "files", directory));
  } else if (outcome.is_remarkable()) {
    print_note(outcome.message);
  }
}

// Of an ensemble: from its start, or from a checkpoint.
template <class Run>
ExitCode run_ensemble(const RunArguments& arguments, const std::string& directory, const Run& run) {
  try {
    const EnsembleCaseResult result = run();
    print(arguments, directory, result);
    return exit_code(result.outcome.status(), result.outcome.violated > 0);
  } catch (const Error& error) {
    if (!has_stopped()) throw;
    print_note(error.what());  // a signal came before the members were set up
    return interrupted;
  }
}

ExitCode run(const NewRunArguments& arguments) {
  const Ranks* const ranks = processes();
  if (!is_first()) return follow(arguments, *ranks);
  answer_signals(ranks != nullptr ? "" : "stopped before the first step");
  hdf5_without_cleanup_at_exit();
  RunSpec spec;
  on_first(ranks, [&] {
    spec = load_case(arguments.case_argument);
    if (arguments.directory_given && arguments.directory.empty()) throw Error("--out must not be empty");
    if (arguments.directory_given) spec.output_directory = arguments.directory;
    require_single_run(spec, ranks);
  });
  RunCaseOptions options = run_options(arguments, ranks);
  if (spec.ensemble)
    return run_ensemble(arguments, spec.output_directory,
                        [&] { return run_ensemble_case(spec, spec.output_directory, options); });
  Progress progress(stderr, spec.t_end);
  if (ProgressBar::is_wanted(arguments.quiet)) options.observers.push_back(&progress);
  const CaseResult result = run_case(spec, spec.output_directory, options);
  print(arguments, spec.output_directory, result);
  return exit_code(result.report.status, result.report.law == LawVerdict::violated);
}

ExitCode resume(const ResumeArguments& arguments) {
  const Ranks* const ranks = processes();
  if (!is_first()) return follow(arguments, *ranks);
  answer_signals(ranks != nullptr ? ""
                                  : "stopped before the run went on; its files and its checkpoint are as they were");
  hdf5_without_cleanup_at_exit();
  const std::string& directory = arguments.directory;
  RunCaseOptions options = run_options(arguments, ranks);
  Progress progress(stderr, 0);
  options.ends_at = [&progress](double t_end) { progress.end_at(t_end); };
  std::optional<GoingOn> from;
  on_first(ranks, [&] {
    from = going_on(directory, arguments.until, options);
    require_single_run(from->spec, ranks);
  });
  if (from->spec.ensemble)
    return run_ensemble(arguments, directory, [&] { return resume_ensemble_case(std::move(*from), options); });
  if (ProgressBar::is_wanted(arguments.quiet)) options.observers.push_back(&progress);
  const CaseResult result = resume_case(std::move(*from), options);
  print(arguments, directory, result);
  return exit_code(result.report.status, result.report.law == LawVerdict::violated);
}

const CLI::Validator hours(
    [](const std::string& text) {
      double value = 0;  // as CLI11 reads the option itself
      const bool is_one = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0;
      return is_one ? std::string() : fmt::format("'{}' is no finite number > 0", shortened(text));
    },
    "");

// The options of both commands.
void add_options(CLI::App& command, RunArguments& arguments) {
  command
      .add_option("--threads", arguments.threads,
                  "Threads, over a large grid or the members of an ensemble; results do not depend on it")
      ->type_name("N")
      ->check(whole_number(1, most_threads));
  command
      .add_option("--max-hours", arguments.max_hours,
                  "Write a checkpoint and stop after so much time, as a queue allows")
      ->type_name("H")
      ->check(hours);
  command.add_flag("--json", arguments.json, "Print summary.json on stdout");
  CLI::Option* quiet =
      command.add_flag("--quiet", arguments.quiet, "No progress bar, and a word only when something went wrong");
  command
      .add_flag("--verbose", arguments.verbose,
                "Also how often V and its gradient were evaluated, and the theorem behind the law")
      ->excludes(quiet);
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<NewRunArguments>();
  CLI::App* command =
      app.add_subcommand("run", "Run one case; its report goes to stderr, with --json its summary to stdout");
  add_case(*command, arguments->case_argument);
  CLI::Option* out =
      command->add_option("-o,--out", arguments->directory, "Where the files go, instead of output.directory")
          ->type_name("DIR");
  add_options(*command, *arguments);
  command->add_flag("--restart", arguments->restart,
                    "Begin anew where the folder holds a run that did not finish, which is removed");
  command->callback([arguments, out, &action] {
    arguments->directory_given = out->count() > 0;
    action = [arguments] { return run(*arguments); };
  });
}

void add_resume(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ResumeArguments>();
  CLI::App* command = app.add_subcommand("resume", "Go on with a run that was stopped or killed, from its checkpoint");
  command->add_option("DIR", arguments->directory, "The directory that the run left")->required()->type_name("");
  command->add_option("--until", arguments->until, "Where to end, instead of time.end of its case")->type_name("T");
  add_options(*command, *arguments);
  command->callback([arguments, &action] { action = [arguments] { return resume(*arguments); }; });
}

}  // namespace seiche::cli
