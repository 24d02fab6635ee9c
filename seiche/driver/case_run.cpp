#include <seiche/config/case/case_file.hpp>
#include <seiche/config/data/initial_file.hpp>
#include <seiche/core/error.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/driver/case_run.hpp>
#include <seiche/driver/headline.hpp>
#include <seiche/driver/last_words.hpp>
#include <seiche/figure/run_report.hpp>
#include <seiche/law/law.hpp>
#include <seiche/output/summary.hpp>
#include <seiche/version.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <functional>
#include <limits>
#include <utility>

namespace seiche {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const std::map<std::string, std::string>& versions) {
  std::vector<std::string> lines;
  for (const auto& [name, version] : versions) lines.push_back(fmt::format("{} {}", name, version));
  return lines;
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

RunPlan plan(const RunSpec& spec, int threads) {
  RunPlan plan{.simulation = simulation_options(spec),
               .h = spec.h,
               .tolerance = spec.tolerance,
               .h_max = spec.h_max,
               .t_start = spec.t_start,
               .t_end = spec.t_end};
  plan.simulation.backend_options.threads = threads;
  return plan;
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
  try {
    solution.settle(leave);
  } catch (const Error&) {  // what it holds is the same
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

CaseRun::CaseRun(RunSpec spec, const Problem& problem, const RunCaseOptions& options, GoingOn* from)
    : spec_(std::move(spec)),
      options_(options),
      versions_(all_versions(options)),
      problem_(problem.name),
      run_(problem, plan(spec_, options.threads)),
      is_modified_(run_.simulation().stepper().has_modified_energy()),
      from_(from),
      folder_(from != nullptr ? &from->folder : nullptr) {
  if (from_ != nullptr) {
    go_on();
  } else {
    begin(problem);
  }
}

CaseResult CaseRun::result() {
  const Folder& folder = folder_->folder();
  Simulation& simulation = run_.simulation();
  const auto summary = [this](const RunReport& report) { return this->summary(report); };
  LastWords last_words(folder, simulation, summary);
  if (from_ != nullptr && from_->new_end) write_new_end(folder, case_text_, *from_->new_end);
  make_files();
  if (from_ != nullptr) take_over();
  EnergyTrace& trace = *trace_;
  SolutionFile& solution = *solution_;
  if (spec_.ledger) simulation.stepper().keep_ledger();
  solution.before_writing([&] { trace.flush(); });
  const auto warn = [this](const std::string& note) { this->warn(note); };
  keeper_.emplace(folder,
                  CheckpointKeeper::Options{.when = spec_.checkpoint,
                                            .asked = options_.save,
                                            .seconds = 3600 * options_.max_hours,
                                            .describe = [this](SavedRun& saved) { describe(saved); },
                                            .warn = warn},
                  from_ != nullptr ? &from_->from.run : nullptr);
  const std::atomic<bool>* leave = nullptr;
  AtTheEnd hold([&](const RunReport&) { leave = options_.ends ? options_.ends() : nullptr; });
  AtTheEnd words([&](const RunReport& report) { last_words.write(with_way_on(report)); });
  std::vector<Observer*> observers = {&hold, &trace, &words, &solution};
  observers.insert(observers.end(), options_.observers.begin(), options_.observers.end());

  const Resumption resumption{.checkpoints = &*keeper_, .from = from_ != nullptr ? &from_->from.rest : nullptr};
  RunReport report = with_way_on(run_.integrate(*stop_, observers, resumption));
  if (report.status == RunReport::Status::success) remove_checkpoints(folder);
  last_words.correct(report);
  // From here on nothing is lost: it can all be had again from the files that are there.
  std::uint64_t xdmf_every = 1;
  const std::string failure = write_for_readers(folder, spec_, solution, leave, warn, xdmf_every);
  if (!failure.empty()) {
    report.status = RunReport::Status::failed;
    report.message += "; " + failure;
    last_words.correct(report);
  }
  return {.report = report,
          .message = with_notes(report).message,
          .certificate = run_.certificate_after(report),
          .feeds = simulation.problem().friction ? "" : negative_rate(simulation.problem()),
          .summary = summary(report),
          .xdmf_every = xdmf_every};
}

void CaseRun::begin(const Problem& problem) {
  spec_.notes.insert(spec_.notes.end(), run_.notes().begin(), run_.notes().end());
  if (const auto* data = std::get_if<FileData>(&spec_.initial)) {
    const std::string lost = lost_between_runs(run_.simulation(), spec_.t_start, time_of_final_state(data->file));
    if (!lost.empty()) spec_.notes.push_back(lost);
  }
  notes_ = case_notes(spec_, problem);
  case_text_ = write_case(spec_);
  hashes_ = hashes_of(spec_, case_text_);
  stop_ = begin_run(options_);
  folder_ = &own_folder_.emplace(spec_.output_directory, RunKind::run, spec_, options_.restart);
  if (options_.introduce) options_.introduce(headline(spec_, run_.simulation()), notes_);
  if (spec_.measure_plans) write_file(folder_->folder(), wisdom_name, planning_wisdom());
}

void CaseRun::go_on() {
  const SavedRun& saved = from_->from.run;
  notes_ = saved.notes;
  case_text_ = from_->new_end ? write_case(spec_) : saved.case_text;
  hashes_ = saved.hashes;
  hashes_["case.toml"] = sha256(case_text_);
  std::vector<std::string> said = {
      fmt::format("going on from {}, t = {:.9g} (step {})", from_->from.name, saved.t, saved.steps)};
  for (const std::string& version : lines_of(versions_))
    if (std::find(saved.versions.begin(), saved.versions.end(), version) == saved.versions.end())
      said.push_back(fmt::format("the checkpoint was not written by {}: last bits may differ", version));
  notes_.insert(notes_.end(), said.begin() + 1, said.end());
  stop_ = begin_run(options_);
  if (options_.introduce) options_.introduce(headline(spec_, run_.simulation()), said);
}

// A case.toml that others have written is kept, and does not count.
void CaseRun::take_over() {
  const Folder& folder = folder_->folder();
  const fs::path path = folder.path() / "case.toml";
  const std::string found = text_of_file(path);
  if (found != case_text_ && found != from_->from.run.case_text) {
    const bool is_there = look_at(path).kind != InputKind::missing;
    notes_.push_back(is_there ? fmt::format("case.toml was not that of the checkpoint, which counts: it is {} now",
                                            put_aside(folder, "case.toml", "case_before_resume.toml"))
                              : "case.toml was missing: it is that of the checkpoint again");
    warn(notes_.back());
  }
  if (found != case_text_) write_file(folder, "case.toml", case_text_);
  // What they tell is of a run that had stopped.
  for (const char* name : {"summary.json", "final.txt", "solution.xdmf"}) remove_file(folder, name);
  if (folder.is_at_its_path()) remove_own_report(folder.path());
}

void CaseRun::warn(const std::string& note) const {
  if (options_.warn) options_.warn(note);
}

void CaseRun::make_files() {
  const Folder& folder = folder_->folder();
  const Simulation& simulation = run_.simulation();
  const Space& space = *simulation.system().space;
  const Schedule energy_steps{.every_steps = spec_.energy_every};
  const SnapshotTimes times{.schedule = {.every_steps = spec_.snapshot_every}, .interval = spec_.snapshot_interval};
  const SolutionDescription about = description(spec_, simulation, versions_);
  if (from_ != nullptr) {
    // First the one of which a copy needs room: where that is missing, all files are what they were.
    const SavedRun& saved = from_->from.run;
    solution_.emplace(folder, saved.solution, simulation.problem(), space, times, is_modified_, about);
    trace_.emplace(folder, saved.energies, is_modified_, energy_steps, spec_.ledger);
  } else {
    trace_.emplace(folder, is_modified_, energy_steps, spec_.ledger);
    solution_.emplace(folder, simulation.problem(), space, times, is_modified_, about);
  }
}

void CaseRun::describe(SavedRun& saved) {
  const State& state = run_.simulation().state();
  saved = {.versions = lines_of(versions_),
           .case_text = case_text_,
           .hashes = hashes_,
           .notes = notes_,
           .resumed_at = {},
           .resumed_with = resumed_with(),
           .new_end = {},
           .t = state.t,
           .steps = state.n,
           .energies = trace_->mark(),
           .solution = solution_->mark()};
  for (const ResumedWith& resumed : saved.resumed_with) saved.resumed_at.push_back(resumed.t);
}

RunReport CaseRun::with_way_on(RunReport report) const {
  // With the same settings it would fail again: those of another run are to be others.
  if (report.step_failed && report.t > spec_.t_start)
    report.message += fmt::format(
        "; another run goes on from there, with other settings, by initial = {{ file = \"{}\" }} and start = {} in [time]",
        (folder_->folder().path() / "final.txt").string(), report.t);
  if (report.status != RunReport::Status::interrupted) return report;
  if (keeper_->is_out_of_time()) report.message += fmt::format(", after {:.3g} hours as asked", options_.max_hours);
  if (const std::optional<double> t = keeper_->saved_t())
    report.message += fmt::format("; `seiche resume {}` goes on from {}", folder_->folder().path().string(),
                                  *t == report.t ? "there" : fmt::format("a checkpoint at t = {:.9g}", *t));
  return report;
}

RunReport CaseRun::with_notes(RunReport report) const {
  for (const std::string& note : notes_) report.message += "; " + note;
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
                       .versions = versions_,
                       .resumed_with = resumed_with(),
                       .threads = options_.threads,
                       .hashes = hashes_,
                       .finished = *finished_},
                      with_notes(report));
}

std::vector<ResumedWith> CaseRun::resumed_with() const {
  if (from_ == nullptr) return {};
  const SavedRun& saved = from_->from.run;
  std::vector<ResumedWith> all = saved.resumed_with;
  all.push_back({.t = saved.t, .versions = versions_, .end = from_->new_end ? from_->new_end : saved.new_end});
  return all;
}

}  // namespace seiche
