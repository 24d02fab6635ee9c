// seiche run: one case, one method, and the files that a run leaves.
#include "command_line.hpp"
#include "last_words.hpp"
#include "load_case.hpp"
#include "run_ensemble.hpp"
#include "stop_signal.hpp"
#include "versions.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <seiche/config/case/case_file.hpp>
#include <seiche/config/data/initial_file.hpp>
#include <seiche/core/error.hpp>
#include <seiche/figure/run_report.hpp>
#include <seiche/law/law.hpp>
#include <seiche/output/energy_trace.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/file/folder_lock.hpp>
#include <seiche/output/progress.hpp>
#include <seiche/output/run_folder.hpp>
#include <seiche/output/solution_file.hpp>
#include <seiche/output/summary.hpp>
#include <seiche/problem/problems.hpp>
#include <seiche/run/adaptive.hpp>
#include <seiche/run/integrate.hpp>
#include <seiche/simulation/certificate.hpp>
#include <seiche/simulation/kick_stability.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/version.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <span>
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

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

ExitCode exit_code(const RunReport& report) {
  switch (report.status) {
    case RunReport::Status::failed: return computation_failed;
    case RunReport::Status::interrupted: return interrupted;
    case RunReport::Status::success: break;
  }
  return report.law == LawVerdict::violated ? law_violated : success;
}

RunReport integrate(Simulation& simulation, const RunSpec& spec, const LawPromise& law, const std::atomic<bool>& stop,
                    std::span<Observer* const> observers) {
  const auto objection = [&] { return negative_rate(simulation.problem()); };
  return integrate_either(simulation.system(), simulation.stepper(),
                          spec.tolerance ? &simulation.adaptive_stepper() : nullptr, simulation.state(),
                          {.tolerance = spec.tolerance.value_or(0.0),
                           .t_end = spec.t_end,
                           .first_h = spec.h,
                           .largest_h = spec.h_max,
                           .law = law,
                           .objection = objection,
                           .stop = &stop},
                          observers);
}

// What solution.h5 says about itself: under the names of the CF conventions where these have one.
SolutionDescription description(const RunSpec& spec, const Simulation& simulation) {
  const ProblemEntry& problem = problem_entry(spec);
  const MethodEntry& method = simulation.method();
  return {.meanings = problem.meanings,
          .texts = {{"title", fmt::format("{} by {}", problem.name, method.name)},
                    {"source", fmt::format("Seiche {} ({})", version_number, version_commit)},
                    {"references", fmt::format("{}; {}", problem.reference, method.reference)},
                    {"comment", "Numbers are in the units of the case, whose equation carries none."},
                    {"problem", problem.name},
                    {"equation", problem.equation},
                    {"method", std::string(method.name)},
                    {"backend", std::string(simulation.backend().name)},
                    {"case", write_case(spec)},
                    {"versions", nlohmann::json(versions()).dump()}}};
}

// Drawing takes longer than many runs: the pictures are left to `seiche plot`.
void write_page(const std::filesystem::path& directory, bool ledger) {
  const EnergyHistory history = ledger ? read_energy_history(directory / "energy.csv") : EnergyHistory{};
  write_run_report(read_run(directory), history, {});
}

// What no sample showed, the run has met.
Certificate as_met(Certificate certificate, const RunReport& report) {
  if (!certificate.law.promised || report.law != LawVerdict::not_promised) return certificate;
  certificate.law = {.promised = false, .reason = report.law_reason};
  certificate.theorem.clear();
  return certificate;
}

// For ParaView and for people, unless a signal says that nobody waits for it. Returns why the page could not be
// written, or "".
std::string write_for_readers(const Folder& folder, const RunSpec& spec, const SolutionFile& solution,
                              const std::atomic<bool>& leave) {
  if (!folder.has_lock()) return "";  // the run has said so
  try {
    solution.describe(&leave);
  } catch (const Error& error) {
    print_note(fmt::format("there is no solution.xdmf, and ParaView cannot open the solution: {}", error.what()));
  }
  if (!folder.is_at_its_path()) {
    print_note(fmt::format(
        "there is no report.html, since {} leads to another folder by now; the files are where it led to at the start",
        folder.path().string()));
    return "";
  }
  if (leave) {
    print_note("stopped before solution.xdmf and report.html were complete; everything else is there");
    return "";
  }
  try {
    if (spec.report) write_page(folder.path(), spec.ledger);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

ExitCode run(const RunArguments& arguments) {
  hdf5_without_cleanup_at_exit();
  RunSpec spec = load_case(arguments.case_argument);
  if (arguments.directory_given && arguments.directory.empty()) throw Error("--out must not be empty");
  if (arguments.directory_given) spec.output_directory = arguments.directory;
  if (spec.ensemble) {
    return run_ensemble_case(spec, {.threads = arguments.threads,
                                    .restart = arguments.restart,
                                    .json = arguments.json,
                                    .quiet = arguments.quiet});
  }
  const std::filesystem::path directory = spec.output_directory;
  const std::filesystem::path wisdom = directory / "fftw_wisdom";
  if (spec.measure_plans) use_planning_wisdom(text_of(wisdom));  // a run repeated in its directory plans the same way
  const Problem problem = make_problem(spec);
  settle_snapshots(spec, problem);
  SimulationOptions simulation_with = simulation_options(spec);
  simulation_with.backend_options.threads = arguments.threads;
  Simulation simulation(problem, simulation_with);
  // Cheap beside a run: what structure leaves open is not looked at here.
  if (!spec.tolerance)
    for (const std::string& note : notes_on_step_size(simulation, spec.sparse, spec.h, spec.t_end))
      spec.notes.push_back(note);
  if (std::holds_alternative<FileData>(spec.initial))
    if (const std::string lost = lost_between_runs(simulation); !lost.empty()) spec.notes.push_back(lost);
  Certificate certificate = certify(problem, {.method = spec.method,
                                              .method_options = spec.method_options,
                                              .t_end = spec.t_end,
                                              .sample_solution = false,
                                              .at_start = &simulation});
  const LawPromise law = certificate.law;
  const std::atomic<bool>& stop = stop_on_signal();  // until here, a signal simply ends the program
  const std::vector<std::string> said_before = notes(spec, problem);
  if (!arguments.quiet) print_notes(said_before);

  make_directory(directory);
  const Folder folder(directory);
  const FolderLock lock(folder);
  require_own_files(directory, RunKind::run, spec.report);
  if (!arguments.restart) require_finished(directory);
  remove_earlier_results(directory);
  remove_own_report(directory);
  remove_pictures(directory);
  write_file(folder, "case.toml", write_case(spec));
  if (spec.measure_plans) write_file(folder, wisdom.filename().string(), planning_wisdom());
  const bool modified = simulation.stepper().has_modified_energy();
  const RunIdentity about{.problem = problem.name,
                          .method = spec.method,
                          .backend = std::string(simulation.backend().name),
                          .h = spec.tolerance ? std::numeric_limits<double>::quiet_NaN() : spec.h,
                          .tolerance = spec.tolerance,
                          .versions = versions()};
  const auto with_notes = [&](const RunReport& report) {
    RunReport all = report;
    for (const std::string& note : said_before) all.message += "; " + note;
    return all;
  };
  const auto summary = [&](const RunReport& report) {
    RunIdentity identity = about;
    identity.certificate = certificate_json(as_met(certificate, report));
    return summary_json(identity, with_notes(report));
  };
  LastWords last_words(folder, simulation, summary);
  EnergyTrace trace(folder, modified, {.every_steps = spec.energy_every}, spec.ledger);
  if (spec.ledger) simulation.stepper().keep_ledger();
  SolutionFile solution(folder, simulation.problem(), *simulation.system().space,
                        {.schedule = {.every_steps = spec.snapshot_every}, .interval = spec.snapshot_interval},
                        modified, description(spec, simulation));
  solution.before_writing([&] { trace.flush(); });
  Progress progress(stderr, spec.t_end);
  const std::atomic<bool>* leave = nullptr;
  AtTheEnd hold([&](const RunReport&) { leave = &hold_signals(); });
  AtTheEnd words([&](const RunReport& report) { last_words.write(report); });
  std::vector<Observer*> observers = {&hold, &trace, &words, &solution};
  if (ProgressBar::is_wanted(arguments.quiet)) observers.push_back(&progress);

  RunReport report = integrate(simulation, spec, law, stop, observers);
  certificate = as_met(std::move(certificate), report);
  last_words.correct(report);
  // From here on nothing is lost: it can all be had again from the files that are there.
  const std::string page_failure = write_for_readers(folder, spec, solution, *leave);
  if (!page_failure.empty()) {
    report.status = RunReport::Status::failed;
    report.message += "; " + page_failure;
    last_words.correct(report);
  }
  if (arguments.json) print_data(summary(report));
  if (!arguments.quiet) {
    print_lines(report.full());  // the notes stand above it already
    if (law.promised && report.law != LawVerdict::not_promised)
      print_lines(fmt::format("{:<10} {}\n", "theorem", certificate.theorem));
    print_lines(fmt::format("{:<10} {}\n", "files", directory.string()));
    // Again, where a reader's eye ends.
    if (report.drift) print_note(fmt::format("{}, and what came out may be inaccurate", report.drift->text()));
    if (report.replaced.count > 0)
      print_note(fmt::format("{} of {} steps {} replaced, and what followed may be inaccurate", report.replaced.count,
                             report.steps, report.replaced.count == 1 ? "was" : "were"));
  } else if (report.status == RunReport::Status::failed || report.law == LawVerdict::violated ||
             !report.remarks().empty()) {
    print_note(with_notes(report).message);
  } else if (const std::string negative = negative_rate(simulation.problem()); !negative.empty() && !problem.friction) {
    // mostly a sign typed wrong; of friction it may be the point
    print_note(fmt::format("{}: it feeds energy, and no energy law is promised", negative));
  }
  return exit_code(report);
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
