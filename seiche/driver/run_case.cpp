#include <seiche/config/case/case_file.hpp>
#include <seiche/config/data/initial_file.hpp>
#include <seiche/core/error.hpp>
#include <seiche/driver/case_folder.hpp>
#include <seiche/driver/last_words.hpp>
#include <seiche/driver/run_case.hpp>
#include <seiche/figure/run_report.hpp>
#include <seiche/law/law.hpp>
#include <seiche/output/energy_trace.hpp>
#include <seiche/output/run_folder.hpp>
#include <seiche/output/solution_file.hpp>
#include <seiche/output/summary.hpp>
#include <seiche/simulation/prepared_run.hpp>
#include <seiche/version.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace seiche {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// What solution.h5 says about itself: under the names of the CF conventions where these have one.
SolutionDescription description(const RunSpec& spec, const Simulation& simulation,
                                const std::map<std::string, std::string>& versions) {
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
                    {"versions", nlohmann::json(versions).dump()}}};
}

RunPlan plan(const RunSpec& spec, int threads) {
  RunPlan plan{.simulation = simulation_options(spec),
               .h = spec.h,
               .tolerance = spec.tolerance,
               .h_max = spec.h_max,
               .t_end = spec.t_end};
  plan.simulation.backend_options.threads = threads;
  return plan;
}

// Drawing takes longer than many runs: the pictures are left to `seiche plot`.
void write_page(const fs::path& directory, bool ledger) {
  const EnergyHistory history = ledger ? read_energy_history(directory / "energy.csv") : EnergyHistory{};
  write_run_report(read_run(directory), history, {});
}

// For ParaView and for people, unless nobody waits for it any more. Returns why the page could not be written, or "".
std::string write_for_readers(const Folder& folder, const RunSpec& spec, const SolutionFile& solution,
                              const std::atomic<bool>* leave, const std::function<void(const std::string&)>& warn) {
  if (!folder.has_lock()) return "";  // the run has said so
  try {
    solution.describe(leave);
  } catch (const Error& error) {
    warn(fmt::format("there is no solution.xdmf, and ParaView cannot open the solution: {}", error.what()));
  }
  if (!folder.is_at_its_path()) {
    warn(fmt::format(
        "there is no report.html, since {} leads to another folder by now; the files are where it led to at the start",
        folder.path().string()));
    return "";
  }
  if (leave != nullptr && *leave) {
    warn("stopped before solution.xdmf and report.html were complete; everything else is there");
    return "";
  }
  try {
    if (spec.report) write_page(folder.path(), spec.ledger);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class CaseRun {
 public:
  CaseRun(RunSpec spec, const Problem& problem, const fs::path& directory, const RunCaseOptions& options)
      : spec_(std::move(spec)),
        options_(options),
        versions_(all_versions(options)),
        problem_(problem.name),
        run_(problem, plan(spec_, options.threads)),
        is_modified_(run_.simulation().stepper().has_modified_energy()) {
    spec_.notes.insert(spec_.notes.end(), run_.notes().begin(), run_.notes().end());
    if (std::holds_alternative<FileData>(spec_.initial))
      if (const std::string lost = lost_between_runs(run_.simulation()); !lost.empty()) spec_.notes.push_back(lost);
    notes_ = case_notes(spec_, problem);
    stop_ = begin_run(options, notes_);
    folder_.emplace(directory, RunKind::run, spec_, options.restart);
    if (spec_.measure_plans) write_file(folder_->folder(), wisdom_name, planning_wisdom());
  }

  CaseResult result() {
    const Folder& folder = folder_->folder();
    Simulation& simulation = run_.simulation();
    const auto summary = [this](const RunReport& report) { return this->summary(report); };
    LastWords last_words(folder, simulation, summary);
    EnergyTrace trace(folder, is_modified_, {.every_steps = spec_.energy_every}, spec_.ledger);
    if (spec_.ledger) simulation.stepper().keep_ledger();
    SolutionFile solution(folder, simulation.problem(), *simulation.system().space,
                          {.schedule = {.every_steps = spec_.snapshot_every}, .interval = spec_.snapshot_interval},
                          is_modified_, description(spec_, simulation, versions_));
    solution.before_writing([&] { trace.flush(); });
    const std::atomic<bool>* leave = nullptr;
    AtTheEnd hold([&](const RunReport&) { leave = options_.ends ? options_.ends() : nullptr; });
    AtTheEnd words([&](const RunReport& report) { last_words.write(report); });
    std::vector<Observer*> observers = {&hold, &trace, &words, &solution};
    observers.insert(observers.end(), options_.observers.begin(), options_.observers.end());

    RunReport report = run_.integrate(*stop_, observers);
    last_words.correct(report);
    // From here on nothing is lost: it can all be had again from the files that are there.
    const auto warn = [this](const std::string& note) {
      if (options_.warn) options_.warn(note);
    };
    if (const std::string failure = write_for_readers(folder, spec_, solution, leave, warn); !failure.empty()) {
      report.status = RunReport::Status::failed;
      report.message += "; " + failure;
      last_words.correct(report);
    }
    return {.report = report,
            .message = with_notes(report).message,
            .certificate = run_.certificate_after(report),
            .feeds = simulation.problem().friction ? "" : negative_rate(simulation.problem()),
            .summary = summary(report)};
  }

  static constexpr const char* wisdom_name = "fftw_wisdom";

 private:
  RunReport with_notes(RunReport report) const {
    for (const std::string& note : notes_) report.message += "; " + note;
    return report;
  }

  std::string summary(const RunReport& report) {
    const Simulation& simulation = run_.simulation();
    return summary_json({.problem = problem_,
                         .method = spec_.method,
                         .backend = std::string(simulation.backend().name),
                         .h = spec_.tolerance ? std::numeric_limits<double>::quiet_NaN() : spec_.h,
                         .tolerance = spec_.tolerance,
                         .certificate = certificate_json(run_.certificate_after(report)),
                         .versions = versions_},
                        with_notes(report));
  }

  RunSpec spec_;
  const RunCaseOptions& options_;
  std::map<std::string, std::string> versions_;
  std::string problem_;
  PreparedRun run_;
  bool is_modified_;
  std::vector<std::string> notes_;
  const std::atomic<bool>* stop_ = nullptr;
  std::optional<CaseFolder> folder_;
};

}  // namespace

CaseResult run_case(RunSpec spec, const fs::path& folder, const RunCaseOptions& options) {
  spec.output_directory = folder.string();
  // A run repeated in its folder plans its transforms the same way.
  if (spec.measure_plans) use_planning_wisdom(text_of(folder / CaseRun::wisdom_name));
  const Problem problem = make_problem(spec);
  settle_snapshots(spec, problem);
  return CaseRun(std::move(spec), problem, folder, options).result();
}

}  // namespace seiche
