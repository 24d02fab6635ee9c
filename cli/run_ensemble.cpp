#include "run_ensemble.hpp"
#include "load_case.hpp"
#include "stop_signal.hpp"
#include "versions.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <seiche/config/case/case_file.hpp>
#include <seiche/core/error.hpp>
#include <seiche/ensemble/ensemble.hpp>
#include <seiche/ensemble/members.hpp>
#include <seiche/figure/run_pictures.hpp>
#include <seiche/law/law.hpp>
#include <seiche/output/csv_row.hpp>
#include <seiche/output/csv_text.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/file/folder_lock.hpp>
#include <seiche/output/file/reserve_file.hpp>
#include <seiche/output/run_folder.hpp>
#include <seiche/simulation/certificate.hpp>
#include <seiche/simulation/kick_stability.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace seiche::cli {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

// energy.csv, row by row as the run goes on.
class StatisticsFile {
 public:
  StatisticsFile(const Folder& folder, bool has_modified) : file_(folder, "energy.csv"), has_modified_(has_modified) {
    std::string header = "t,members";
    for (const char* of : {"H", "H_modified"}) {
      if (std::string_view(of) == "H_modified" && !has_modified) continue;
      for (const char* what : {"mean", "sd", "min", "q05", "median", "q95", "max"})
        header += fmt::format(",{}_{}", of, what);
    }
    file_.write(header + "\n");
  }

  void write(const EnsembleRecord& record) {
    if (last_.running == 0) first_ = record;
    last_ = record;
    row_.clear();
    row_.add(record.t);
    row_.add(static_cast<double>(record.running));
    add(record.H);
    if (has_modified_) add(record.modified);
    file_.write(row_.line());
    file_.flush();  // records are far apart
    file_.keep_lines();
  }
  void commit() { file_.commit_lines(); }

  // Of members whose energy was a number; without any, statistics of nothing.
  const EnsembleRecord& first() const { return first_; }
  const EnsembleRecord& last() const { return last_; }

 private:
  void add(const Statistics& s) {
    for (const double x : {s.mean, s.standard_deviation, s.minimum, s.low, s.median, s.high, s.maximum}) row_.add(x);
  }
  AtomicFile file_;
  bool has_modified_;
  CsvRow row_;
  EnsembleRecord first_{.H = statistics({}), .modified = statistics({})};
  EnsembleRecord last_ = first_;
};

std::string energy_columns(const EnergySummary& e) {
  return fmt::format(",{:.17g},{:.17g},{:.17g}", e.initial, e.final, e.max_increase);
}

void write_members(const Folder& folder, const Members& members, const EnsembleResult& result, bool has_modified) {
  AtomicFile file(folder, "members.csv");
  std::string header = "member";
  for (const std::string& name : members.parameters) header += "," + name;
  header += ",status,steps,t,H_initial,H_final,max_increase";
  if (has_modified) header += ",H_modified_initial,H_modified_final,max_modified_increase";
  file.write(header + ",law,scalar_iterations,fallbacks,replaced,message\n");
  for (std::size_t m = 0; m < result.members.size(); ++m) {
    const RunReport& report = result.members[m].report;
    std::string row = fmt::format("{}", m + 1);
    for (const double value : members.values[m]) row += fmt::format(",{:.17g}", value);
    row += fmt::format(",{},{},{:.17g}", to_string(report.status), report.steps, report.t);
    const bool started = result.members[m].final.size() > 0;
    row += started ? energy_columns(report.energy) : ",,,";
    if (has_modified) row += started ? energy_columns(report.modified) : ",,,";
    row += fmt::format(",{},{},{},{},{}\n", to_string(report.law), report.scalar_iterations, report.fallbacks,
                       report.replaced.count, csv_quoted(report.message));
    file.write(row);
  }
  file.commit();
}

// One row for each member that started: its last good state.
void write_finals(const Folder& folder, const Problem& problem, const EnsembleResult& result) {
  AtomicFile file(folder, "finals.csv");
  std::string header = "member";
  for (const std::string& field : problem.fields)
    for (Index j = 1; j <= problem.grid.unknowns(); ++j) header += fmt::format(",{}_{}", field, j);
  file.write(header + "\n");
  CsvRow row;
  for (std::size_t m = 0; m < result.members.size(); ++m) {
    if (result.members[m].final.size() == 0) continue;
    row.clear();
    row.add(static_cast<double>(m + 1));
    row.add(result.members[m].final);
    file.write(row.line());
  }
  file.commit();
}

template <class Is>
std::int64_t count(const EnsembleResult& result, const Is& is) {
  return std::count_if(result.members.begin(), result.members.end(),
                       [&](const MemberResult& member) { return is(member.report); });
}

Json statistics_json(const Statistics& s) {
  const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); };
  return {{"mean", number(s.mean)},  {"sd", number(s.standard_deviation)}, {"min", number(s.minimum)},
          {"q05", number(s.low)},    {"median", number(s.median)},         {"q95", number(s.high)},
          {"max", number(s.maximum)}};
}

struct Outcome {
  std::int64_t succeeded, failed, interrupted, replaced, drifted;
  std::int64_t holds, violated, not_promised;  // a law that was kept up to a failure is none of these
  std::string message;
  bool is_written = true;  // is all on disk?

  explicit Outcome(const EnsembleResult& result)
      : succeeded(of(result, RunReport::Status::success)),
        failed(of(result, RunReport::Status::failed)),
        interrupted(of(result, RunReport::Status::interrupted)),
        replaced(count(result, holds_replaced)),
        drifted(count(result, has_drifted)),
        holds(count(result,
                    [](const RunReport& r) {
                      return r.law == LawVerdict::holds && r.status != RunReport::Status::failed;
                    })),
        violated(count(result, [](const RunReport& r) { return r.law == LawVerdict::violated; })),
        not_promised(count(result, [](const RunReport& r) { return r.law == LawVerdict::not_promised; })) {
    message = fmt::format("{} of {} members reached the end", succeeded, result.members.size());
    say_first(
        result, failed, "failed", [](const RunReport& r) { return r.status == RunReport::Status::failed; },
        &RunReport::message);
    say_first(result, replaced, "hold replaced steps", holds_replaced, &RunReport::remark_on_replaced);
    say_first(result, drifted, "have an energy that no solution has", has_drifted, &RunReport::remark_on_drift);
    if (interrupted > 0) message += fmt::format("; {} were interrupted", interrupted);
    say_first(
        result, violated, "violated the promised energy law",
        [](const RunReport& r) { return r.law == LawVerdict::violated; }, &RunReport::law_reason);
    say_first(
        result, not_promised, "promise no energy law",
        [](const RunReport& r) { return r.law == LawVerdict::not_promised; }, &RunReport::law_reason);
    if (!result.failure.empty()) fail_to_write(result.failure);
  }

  void fail_to_write(const std::string& reason) {
    if (message.find(reason) == std::string::npos) message += "; " + reason;
    is_written = false;
  }

  RunReport::Status status() const {
    if (failed > 0 || !is_written) return RunReport::Status::failed;
    return interrupted > 0 ? RunReport::Status::interrupted : RunReport::Status::success;
  }
  // "" where every member failed and none broke a law.
  std::string law() const {
    if (violated > 0) return to_string(LawVerdict::violated);
    if (not_promised > 0) return to_string(LawVerdict::not_promised);
    return holds > 0 ? to_string(LawVerdict::holds) : "";
  }

 private:
  static std::int64_t of(const EnsembleResult& result, RunReport::Status status) {
    return count(result, [status](const RunReport& r) { return r.status == status; });
  }

  // Of members that failed their message says it.
  static bool holds_replaced(const RunReport& r) {
    return r.replaced.count > 0 && r.status != RunReport::Status::failed;
  }

  static bool has_drifted(const RunReport& r) { return r.drift && r.status != RunReport::Status::failed; }

  template <class Is, class Reason>
  void say_first(const EnsembleResult& result, std::int64_t how_many, const char* what, const Is& is,
                 const Reason& reason) {
    if (how_many == 0) return;
    const auto first = std::find_if(result.members.begin(), result.members.end(),
                                    [&](const MemberResult& member) { return is(member.report); });
    message += fmt::format("; {} {}, the first of them member {}: {}", how_many, what,
                           first - result.members.begin() + 1, std::invoke(reason, first->report));
  }
};

ExitCode exit_code(const Outcome& outcome) {
  if (outcome.failed > 0 || !outcome.is_written) return computation_failed;
  if (outcome.interrupted > 0) return interrupted;
  return outcome.violated > 0 ? law_violated : success;
}

std::string summary(const RunSpec& spec, const std::string& backend, const EnsembleResult& result,
                    const Outcome& outcome, const StatisticsFile& energies, bool has_modified,
                    const Certificate& certificate) {
  std::int64_t steps = 0;
  std::int64_t iterations = 0;
  std::int64_t fallbacks = 0;
  std::int64_t replaced = 0;
  for (const MemberResult& member : result.members) {
    steps += member.report.steps;
    iterations += member.report.scalar_iterations;
    fallbacks += member.report.fallbacks;
    replaced += member.report.replaced.count;
  }
  Json energy = {{"initial", statistics_json(energies.first().H)}, {"final", statistics_json(energies.last().H)}};
  energy["modified"] = has_modified ? Json{{"initial", statistics_json(energies.first().modified)},
                                           {"final", statistics_json(energies.last().modified)}}
                                    : Json(nullptr);
  energy["law"] = outcome.law().empty() ? Json(nullptr) : Json(outcome.law());
  Json about = Json::object();
  for (const auto& [name, version] : versions()) about[name] = version;
  const Json json = {
      {"status", to_string(outcome.status())},
      {"message", outcome.message},
      {"problem", spec.problem},
      {"method", spec.method},
      {"backend", backend},
      {"h", spec.h},
      {"members", result.members.size()},
      {"side_by_side", result.in_lanes},
      {"statuses", {{"success", outcome.succeeded}, {"failed", outcome.failed}, {"interrupted", outcome.interrupted}}},
      {"laws", {{"holds", outcome.holds}, {"violated", outcome.violated}, {"not promised", outcome.not_promised}}},
      {"steps", steps},
      {"t", energies.last().t},
      {"energy", energy},
      {"counts", {{"scalar_iterations", iterations}, {"fallbacks", fallbacks}, {"replaced", replaced}}},
      {"wall_seconds", result.wall_seconds},
      {"certificate", Json::parse(certificate_json(certificate))},
      {"versions", about}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Of the first member that starts. A method that applies to no member leaves no files.
std::unique_ptr<Simulation> first_start(const Members& members, const RunSpec& spec) {
  std::optional<Error> first;
  for (const EnsembleMember& member : members.list) {
    try {
      Problem problem = *member.problem;
      problem.initial = member.initial;
      return std::make_unique<Simulation>(problem, simulation_options(spec));
    } catch (const Error& error) {
      if (!first) first = error;
    }
  }
  throw Error(*first);
}

// Where members differ in a parameter, what was made of one problem is not what was made of another.
std::vector<std::string> notes_on(const Members& members, const Simulation& simulation, const RunSpec& spec) {
  Problem first = *members.list.front().problem;
  if (!members.parameters.empty())
    for (std::string& note : first.notes) note.insert(0, "of member 1: ");
  std::vector<std::string> all = notes(spec, first);
  if (spec.tolerance) return all;
  const std::vector<std::string> on_h = notes_on_step_size(simulation, spec.sparse, spec.h, spec.t_end);
  all.insert(all.end(), on_h.begin(), on_h.end());
  return all;
}

}  // namespace

ExitCode run_ensemble_case(const RunSpec& spec, const EnsembleRunOptions& options) {
  const Members members = make_members(spec);
  const Problem& problem = *members.list.front().problem;
  const bool has_modified = find_method(spec.method).kept_energy == "H_modified";
  const std::unique_ptr<Simulation> simulation = first_start(members, spec);
  if (!options.quiet) print_notes(notes_on(members, *simulation, spec));

  // Of the first member; each member's own promise is counted in "laws".
  const Certificate certificate = certify(problem, {.method = spec.method,
                                                    .method_options = spec.method_options,
                                                    .t_end = spec.t_end,
                                                    .sample_solution = false});
  const fs::path directory = spec.output_directory;
  const std::atomic<bool>& stop = stop_on_signal();  // until here, a signal simply ends the program
  make_directory(directory);
  const Folder folder(directory);
  const FolderLock lock(folder);
  require_own_files(directory, RunKind::ensemble, false);
  if (!options.restart) require_finished(directory);
  remove_earlier_results(directory);
  remove_own_report(directory);
  remove_pictures(directory);
  write_file(folder, "case.toml", write_case(spec));
  ReserveFile reserve(folder, 2 * ReserveFile::of_a_summary);
  StatisticsFile energies(folder, has_modified);
  EnsembleResult result;
  try {
    result = run_ensemble(members.list,
                          {.simulation = simulation_options(spec),
                           .h = spec.h,
                           .t_end = spec.t_end,
                           .energy_every = spec.energy_every,
                           .threads = options.threads,
                           .promise = [&](const Simulation& member) { return promise_energy_law(member, spec.t_end); },
                           .objection = negative_rate,
                           .on_record = [&](const EnsembleRecord& record) { energies.write(record); },
                           .stop = &stop});
  } catch (const Error& error) {
    if (!stop) throw;
    print_note(error.what());
    return interrupted;
  }
  Outcome outcome(result);
  // Each gets its chance to be whole, also where another one was not.
  const auto attempt = [&](const auto& write) {
    try {
      write();
    } catch (const Error& error) {
      outcome.fail_to_write(error.what());
    }
  };
  hold_signals();
  attempt([&] { energies.commit(); });
  attempt([&] { write_members(folder, members, result, has_modified); });
  attempt([&] { write_finals(folder, problem, result); });
  const std::string backend =
      spec.backend == "auto" ? std::string(automatic_backend(problem).name) : spec.backend;  // of every member
  const auto summarised = [&] { return summary(spec, backend, result, outcome, energies, has_modified, certificate); };
  reserve.release();
  attempt([&] { write_file(folder, "summary.json", summarised()); });
  const std::string json = summarised();

  if (options.json) print_data(json);
  if (!options.quiet) {
    print_lines(fmt::format("{}: {}\n", to_string(outcome.status()), outcome.message));
    print_lines(fmt::format("{:<10} mean {:.9g} → {:.9g}\n{:<10} {} members in {:.3g} s\n{:<10} {}\n", "H",
                            energies.first().H.mean, energies.last().H.mean, "time", result.members.size(),
                            result.wall_seconds, "files", directory.string()));
  } else if (outcome.failed > 0 || !outcome.is_written || outcome.violated > 0 || outcome.replaced > 0 ||
             outcome.drifted > 0) {
    print_note(outcome.message);
  }
  return exit_code(outcome);
}

}  // namespace seiche::cli
