// seiche run: one case, one method, and the files that a run leaves.
#include "command_line.hpp"
#include "law_promise.hpp"
#include "load_case.hpp"
#include "run_ensemble.hpp"
#include "stop_signal.hpp"
#include "versions.hpp"

#include <fmt/format.h>
#include <seiche/config/case_file.hpp>
#include <seiche/config/simulation.hpp>
#include <seiche/core/error.hpp>
#include <seiche/output/energy_trace.hpp>
#include <seiche/output/final_state.hpp>
#include <seiche/output/progress.hpp>
#include <seiche/output/snapshots.hpp>
#include <seiche/output/summary.hpp>
#include <seiche/run/adaptive.hpp>
#include <seiche/run/integrate.hpp>
#include <seiche/study/certificate.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <span>

namespace seiche::cli {
namespace {

struct RunArguments {
  CaseArgument case_argument;
  std::string directory;
  bool directory_given = false;
  int threads = 1;
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
  if (spec.tolerance) {
    const AdaptiveOptions options{.tolerance = *spec.tolerance,
                                  .t_end = spec.t_end,
                                  .first_h = spec.h,
                                  .largest_h = spec.h_max,
                                  .law = law,
                                  .objection = objection,
                                  .stop = &stop};
    return integrate_adaptive(simulation.system(), simulation.adaptive_stepper(), simulation.state(), options,
                              observers);
  }
  const IntegrateOptions options{.h = spec.h, .t_end = spec.t_end, .law = law, .objection = objection, .stop = &stop};
  return integrate(simulation.system(), simulation.stepper(), simulation.state(), options, observers);
}

ExitCode run(const RunArguments& arguments) {
  RunSpec spec = load_case(arguments.case_argument);
  if (arguments.directory_given && arguments.directory.empty()) throw Error("--out must not be empty");
  if (arguments.directory_given) spec.output_directory = arguments.directory;
  if (spec.ensemble) {
    return run_ensemble_case(spec, {.threads = arguments.threads, .json = arguments.json, .quiet = arguments.quiet});
  }
  const std::filesystem::path directory = spec.output_directory;
  const std::filesystem::path wisdom = directory / "fftw_wisdom";
  if (spec.measure_plans) use_planning_wisdom(text_of(wisdom));  // a run repeated in its directory plans the same way
  const Problem problem = make_problem(spec);
  SimulationOptions simulation_with = simulation_options(spec);
  simulation_with.backend_options.threads = arguments.threads;
  Simulation simulation(problem, simulation_with);
  // Cheap beside a run: what structure leaves open is not looked at here.
  const Certificate certificate = certify(problem, {.method = spec.method,
                                                    .method_options = spec.method_options,
                                                    .t_end = spec.t_end,
                                                    .sample_solution = false,
                                                    .at_start = &simulation});
  const LawPromise& law = certificate.law;
  const std::atomic<bool>& stop = stop_on_signal();  // until here, a signal simply ends the program
  const std::string remarks = notes(spec, problem);
  if (!remarks.empty() && !arguments.quiet) print_note(remarks);

  make_directory(directory);
  write_file(directory / "case.toml", write_case(spec));
  if (spec.measure_plans) write_file(wisdom, planning_wisdom());
  const bool modified = simulation.stepper().has_modified_energy();
  EnergyTrace trace(directory / "energy.csv", modified, {.every_steps = spec.energy_every}, spec.ledger);
  if (spec.ledger) simulation.stepper().keep_ledger();
  Snapshots snapshots(directory / "snapshots.csv", simulation.problem(), *simulation.system().space,
                      {.every_steps = spec.snapshot_every}, spec.snapshot_interval);
  Progress progress(stderr, spec.t_end);
  std::vector<Observer*> observers = {&trace, &snapshots};
  if (ProgressBar::is_wanted(arguments.quiet)) observers.push_back(&progress);

  RunReport report = integrate(simulation, spec, law, stop, observers);
  if (!remarks.empty()) report.message += "; " + remarks;

  const RunIdentity identity{.problem = problem.name,
                             .method = spec.method,
                             .backend = simulation.backend(),
                             .h = spec.tolerance ? std::numeric_limits<double>::quiet_NaN() : spec.h,
                             .tolerance = spec.tolerance,
                             .certificate = certificate_json(certificate),
                             .versions = versions()};
  try {
    write_final_state(directory / "final.txt", simulation.physical());
    write_summary(directory / "summary.json", identity, report);
  } catch (const Error& error) {  // not the user's mistake any more: the directory was writable at the start
    report.status = RunReport::Status::failed;
    report.message += fmt::format("; {}", error.what());
  }
  if (arguments.json) print_data(summary_json(identity, report));
  if (!arguments.quiet) {
    print_lines(report.full());
    if (law.promised && report.law != LawVerdict::not_promised)
      print_lines(fmt::format("{:<10} {}\n", "theorem", certificate.theorem));
    print_lines(fmt::format("{:<10} {}\n", "files", directory.string()));
  } else if (report.status == RunReport::Status::failed || report.law == LawVerdict::violated) {
    print_note(report.message);
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
  command->add_flag("--json", arguments->json, "Print summary.json on stdout");
  command->add_flag("--quiet", arguments->quiet, "No progress bar, and a word only when something went wrong");
  command->callback([arguments, out, &action] {
    arguments->directory_given = out->count() > 0;
    action = [arguments] { return run(*arguments); };
  });
}

}  // namespace seiche::cli
