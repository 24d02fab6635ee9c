#include <seiche/config/case/case_file.hpp>
#include <seiche/config/data/initial_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/driver/case_run.hpp>
#include <seiche/driver/headline.hpp>
#include <seiche/driver/last_words.hpp>
#include <seiche/figure/run_pictures.hpp>
#include <seiche/figure/run_report.hpp>
#include <seiche/law/law.hpp>
#include <seiche/output/summary.hpp>
#include <seiche/record/checkpoint_file.hpp>
#include <seiche/record/run_folder.hpp>
#include <seiche/version.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <functional>
#include <limits>
#include <utility>

namespace seiche {
namespace {

namespace fs = std::filesystem;

constexpr double bytes_per_GB = 1e9;

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
                    {"case", case_in_any_folder(spec)},
                    {"versions", nlohmann::json(versions).dump()}}};
}

// Of the final.txt of a run, whose summary.json knows it; NaN of any other file.
double time_of_final_state(const fs::path& file) {
  nlohmann::json summary;
  if (file.filename() == "final.txt") {
    std::ifstream beside(file.parent_path() / "summary.json");
    summary = nlohmann::json::parse(beside, nullptr, false);
  }
  if (!summary.is_object() || !summary.contains("t") || !summary["t"].is_number())
    return std::numeric_limits<double>::quiet_NaN();
  return summary["t"].get<double>();
}

// Drawing takes longer than many runs: the pictures are left to `seiche plot`.
void write_page(const fs::path& directory, bool ledger) {
  const EnergyHistory history = ledger ? read_energy_history(directory / "energy.csv") : EnergyHistory{};
  write_run_report(read_run(directory), history, {});
}

// Writes solution.xdmf and report.html until `leave` is set. Returns why the page could not be written, or "".
std::string write_for_readers(const Folder& folder, const RunSpec& spec, const SolutionFile& solution,
                              const std::atomic<bool>* leave, const std::function<void(const std::string&)>& warn,
                              std::uint64_t& xdmf_every) {
  if (!folder.has_lock()) return "";  // the run has said so
  // What was drawn while the run went on says so.
  if (folder.is_at_its_path()) {
    remove_pictures(folder.path());
    if (!spec.report) remove_own_report(folder.path());
  }
  try {
    xdmf_every = solution.describe(leave);
  } catch (const Error& error) {
    warn(fmt::format("there is no solution.xdmf, and ParaView cannot open the solution: {}", error.what()));
  }
  if (!folder.is_at_its_path()) {
    warn(fmt::format(
        "there is no report.html, since the folder of this run is not at {} any more; the other files are in it",
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

}  // namespace

Problem problem_here(const RunSpec& spec, const RunCaseOptions& options) {
  std::optional<Problem> problem;
  together(options.ranks, [&] {
    const bool is_whole = options.ranks == nullptr || spec.backend == "petsc";  // which divides it
    problem = make_problem(spec, is_whole ? Rank() : options.ranks->here());
  });
  return std::move(*problem);
}

RunPlan run_plan(const RunSpec& spec, const RunCaseOptions& options) {
  RunPlan plan{.simulation = simulation_options(spec),
               .h = spec.h,
               .tolerance = spec.tolerance,
               .h_max = spec.h_max,
               .t_start = spec.t_start,
               .t_end = spec.t_end};
  plan.simulation.backend_options.threads = options.threads;
  plan.simulation.backend_options.ranks = options.ranks;
  return plan;
}

SnapshotTimes snapshot_times(const RunSpec& spec) {
  return {.schedule = {.every_steps = spec.snapshot_every}, .interval = spec.snapshot_interval};
}

void join_values(const Simulation& simulation, FunctionRef<void(std::span<const double> piece)> take) {
  const Space& space = *simulation.system().space;
  const Vector values = simulation.physical();
  space.join(space.values(), {values.data(), static_cast<std::size_t>(values.size())}, take);
}

std::unique_ptr<CaseRecord> CaseRun::make_record(RunSpec& spec, const Problem& problem, PreparedRun& run,
                                                 const RunCaseOptions& options, GoingOn* from) {
  if (from != nullptr) return std::make_unique<CaseRecord>(*from, headline(spec, run.simulation()), options);
  spec.notes.insert(spec.notes.end(), run.notes().begin(), run.notes().end());
  if (const auto* data = std::get_if<FileData>(&spec.initial)) {
    const std::string lost = lost_between_runs(run.simulation(), spec.t_start, time_of_final_state(data->file));
    if (!lost.empty()) spec.notes.push_back(lost);
  }
  return std::make_unique<CaseRecord>(spec, RunKind::run, headline(spec, run.simulation()), case_notes(spec, problem),
                                      options);
}

CaseRun::CaseRun(RunSpec spec, const Problem& problem, const RunCaseOptions& options, GoingOn* from)
    : spec_(std::move(spec)), options_(options), problem_(problem.name), run_(problem, run_plan(spec_, options)) {
  on_first(options_.ranks, [&] {
    record_ = make_record(spec_, problem, run_, options, from);
    if (from == nullptr && spec_.measure_plans) write_file(record_->folder(), wisdom_name, planning_wisdom());
  });
}

CaseResult CaseRun::result() {
  const Folder& folder = record_->folder();
  Simulation& simulation = run_.simulation();
  const auto summary = [this](const RunReport& report) { return this->summary(report); };
  LastWords last_words(folder, simulation, summary);
  on_first(options_.ranks, [&] {
    record_->put_new_end();
    make_files();
    record_->take_over();
  });
  if (spec_.ledger) simulation.stepper().keep_ledger();
  const auto warn = [this](const std::string& note) { this->warn(note); };
  keeper_.emplace(folder,
                  CheckpointKeeper::Options{.when = spec_.checkpoint,
                                            .asked = options_.save,
                                            .hours = options_.max_hours,
                                            .stops_at_once = options_.stops_at_once,
                                            .now = [this](std::int64_t n, double t) { return now(n, t); },
                                            .warn = warn},
                  record_->saved());
  const std::atomic<bool>* leave = nullptr;
  AtTheEnd hold([&](const RunReport& report) {
    said_by_loop_ = report.message;
    leave = options_.ends ? options_.ends() : nullptr;
  });
  AtTheEnd words([&](const RunReport& report) { last_words.write(with_way_on(report)); });
  // The solution first: where it cannot be written, it makes room for what is said of that.
  std::vector<Observer*> observers = {&hold, &*trace_, &*solution_, &words};
  observers.insert(observers.end(), options_.observers.begin(), options_.observers.end());

  if (options_.ranks != nullptr) joint_.emplace(*options_.ranks, &*keeper_, record_->stop());
  const Resumption resumption{.checkpoints = joint_ ? static_cast<Checkpoints*>(&*joint_) : &*keeper_,
                              .from = record_->rest()};
  const RunReport ended = run_.integrate(joint_ ? never_stops() : record_->stop(), observers, resumption);
  RunReport report = with_way_on(ended);
  last_words.correct(report);
  // From here on nothing is lost: it can all be had again from the files that are there.
  std::uint64_t xdmf_every = 1;
  const std::string failure = write_for_readers(folder, spec_, *solution_, leave, warn, xdmf_every);
  if (!failure.empty()) {
    report.status = RunReport::Status::failed;
    report.say(failure);
    last_words.correct(report);
  }
  if (is_over(ended) && last_words.are_written()) {
    remove_checkpoints(folder);
    if (solution_->is_joined()) remove_segments(folder);
  } else if (is_over(ended)) {
    report.say(keeper_->way_on(report.t));  // which makes the summary again
  }
  return {.report = report,
          .message = with_notes(report).message,
          .certificate = run_.certificate_after(report),
          .feeds = simulation.problem().friction ? "" : negative_rate(simulation.problem()),
          .summary = summary(report),
          .xdmf_every = xdmf_every};
}

void CaseRun::warn(const std::string& note) const {
  if (options_.warn) options_.warn(note);
}

void CaseRun::make_files() {
  const Folder& folder = record_->folder();
  const Simulation& simulation = run_.simulation();
  const bool is_modified = run_.simulation().stepper().has_modified_energy();
  const Schedule energy_steps{.every_steps = spec_.energy_every};
  const SavedRun* saved = record_->saved();
  if (saved != nullptr) {
    trace_.emplace(folder, saved->energies, is_modified, energy_steps, spec_.ledger);
  } else {
    trace_.emplace(folder, is_modified, energy_steps, spec_.ledger);
  }
  solution_.emplace(folder, simulation.problem(), *simulation.system().space, snapshot_times(spec_), is_modified,
                    description(spec_, simulation, record_->versions()),
                    saved != nullptr && saved->solution ? &*saved->solution : nullptr, bytes_per_GB * spec_.join_below,
                    options_.ranks);
}

// The order matters: what a checkpoint vouches for is on the disk before it is.
SavedRun CaseRun::now(std::int64_t n, double t) {
  SavedRun saved = record_->now(n, t);
  saved.solution = solution_->mark();
  saved.energies = trace_->mark();
  return saved;
}

bool CaseRun::is_over(const RunReport& report) const {
  if (report.status == RunReport::Status::success) return true;
  const bool is_whole = solution_->is_finished() && report.message == said_by_loop_;
  return is_whole && report.status == RunReport::Status::failed && (report.step_failed || report.t == spec_.t_end);
}

RunReport CaseRun::with_way_on(RunReport report) const {
  const bool over = is_over(report);
  // With the same settings it would fail again: those of another run are to be others.
  if (report.step_failed && report.t > spec_.t_start)
    report.say(fmt::format(
        "another run goes on from there, with other settings, by initial = {{ file = \"{}\" }} and start = {} in [time]",
        (record_->folder().path() / "final.txt").string(), report.t));
  if (over) return report;
  if (report.status == RunReport::Status::interrupted) report.message += keeper_->why_stopped();
  report.say(keeper_->way_on(report.t));
  return report;
}

RunReport CaseRun::with_notes(RunReport report) const {
  for (const std::string& note : record_->notes()) report.say(note);
  return report;
}

std::string CaseRun::summary(const RunReport& report) {
  const Simulation& simulation = run_.simulation();
  if (!finished_) finished_ = std::time(nullptr);  // what is said again says the same
  return summary_json({.problem = problem_,
                       .method = spec_.method,
                       .backend = std::string(simulation.backend().name),
                       .h = spec_.tolerance ? std::numeric_limits<double>::quiet_NaN() : spec_.h,
                       .tolerance = spec_.tolerance,
                       .certificate = certificate_json(run_.certificate_after(report)),
                       .versions = record_->versions(),
                       .resumed_with = record_->resumed_with(),
                       .threads = options_.threads,
                       .processes = options_.ranks != nullptr ? options_.ranks->here().count : 1,
                       .hashes = record_->hashes(),
                       .finished = *finished_},
                      with_notes(report));
}

}  // namespace seiche
