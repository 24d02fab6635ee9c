#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/simd/thread_count.hpp>
#include <seiche/driver/case_record.hpp>
#include <seiche/driver/checkpoint_keeper.hpp>
#include <seiche/driver/ensemble_files.hpp>
#include <seiche/driver/headline.hpp>
#include <seiche/driver/run_ensemble_case.hpp>
#include <seiche/figure/run_pictures.hpp>
#include <seiche/law/law.hpp>
#include <seiche/simulation/certificate.hpp>
#include <seiche/simulation/kick_stability.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace seiche {
namespace {

using Json = nlohmann::ordered_json;

Json statistics_json(const Statistics& s) {
  const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); };
  return {{"mean", number(s.mean)},  {"sd", number(s.standard_deviation)}, {"min", number(s.minimum)},
          {"q05", number(s.low)},    {"median", number(s.median)},         {"q95", number(s.high)},
          {"max", number(s.maximum)}};
}

std::string summary(const RunSpec& spec, const std::string& backend, const EnsembleResult& result,
                    const EnsembleOutcome& outcome, const StatisticsFile& energies, bool has_modified,
                    const Certificate& certificate, const RunCaseOptions& options, const CaseRecord& record) {
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
  for (const auto& [name, version] : record.versions()) about[name] = version;
  Json json = {{"status", to_string(outcome.status())},
               {"message", outcome.message},
               {"problem", spec.problem},
               {"method", spec.method},
               {"backend", backend},
               {"h", spec.h},
               {"members", result.members.size()},
               {"side_by_side", result.side_by_side},
               {"statuses",
                {{"success", outcome.succeeded}, {"failed", outcome.failed}, {"interrupted", outcome.interrupted}}},
               {"laws",
                {{"holds", outcome.holds}, {"violated", outcome.violated}, {"not promised", outcome.not_promised}}},
               {"steps", steps},
               {"t", energies.last().t},
               {"energy", energy},
               {"counts", {{"scalar_iterations", iterations}, {"fallbacks", fallbacks}, {"replaced", replaced}}},
               {"wall_seconds", result.wall_seconds},
               {"certificate", Json::parse(certificate_json(certificate))},
               {"versions", about},
               {"threads", options.threads},
               {"sha256", record.hashes()}};
  json.update(Json::parse(resumed_json(record.resumed_with())));
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
  std::vector<std::string> all = case_notes(spec, first);
  if (spec.tolerance) return all;
  const std::vector<std::string> on_h =
      notes_on_step_size(simulation, spec.sparse, spec.h, {spec.t_start, spec.duration()});
  all.insert(all.end(), on_h.begin(), on_h.end());
  return all;
}

EnsembleCaseResult run(RunSpec spec, GoingOn* from, const RunCaseOptions& options) {
  require_thread_count(options.threads);
  const Members members = make_members(spec);
  const Problem& problem = *members.list.front().problem;
  const bool has_modified = has_modified_energy(simulation_options(spec));
  const std::unique_ptr<Simulation> simulation = first_start(members, spec);
  // Of the first member; each member's own promise is counted in "laws".
  const Certificate certificate = certify(problem, {.method = spec.method,
                                                    .method_options = spec.method_options,
                                                    .noise = spec.noise,
                                                    .t_start = spec.t_start,
                                                    .t_end = spec.t_end,
                                                    .sample_solution = false});
  std::vector<std::string> notes = notes_on(members, *simulation, spec);
  if (std::string note = note_on_threads(options.threads); !note.empty()) notes.push_back(std::move(note));
  const std::string line = headline(spec, *simulation);
  CaseRecord record = from != nullptr ? CaseRecord(*from, line, options)
                                      : CaseRecord(spec, RunKind::ensemble, line, std::move(notes), options);
  const Folder& folder = record.folder();
  const SavedRun* saved = record.saved();
  record.put_new_end();
  std::optional<StatisticsFile> energies;
  if (saved != nullptr) {
    energies.emplace(folder, has_modified, saved->energies.file, *record.rest());
  } else {
    energies.emplace(folder, has_modified);
  }
  record.take_over();
  CheckpointKeeper keeper(folder,
                          {.when = spec.checkpoint,
                           .asked = options.save,
                           .hours = options.max_hours,
                           .stops_at_once = options.stops_at_once,
                           .now =
                               [&](std::int64_t n, double t) {
                                 SavedRun now = record.now(n, t);
                                 now.energies.file = energies->mark();
                                 return now;
                               },
                           .beside = [&](Archive& archive) { archive(*energies); },
                           .warn = options.warn},
                          saved);
  const EnsembleResult result =
      run_ensemble(members.list,
                   {.simulation = simulation_options(spec),
                    .h = spec.h,
                    .t_start = spec.t_start,
                    .t_end = spec.t_end,
                    .energy_every = spec.energy_every,
                    .threads = options.threads,
                    .promise = [&](const Simulation& member) { return promise_energy_law(member, spec.t_end); },
                    .objection = negative_rate,
                    .on_record =
                        [&](const EnsembleRecord& row) {
                          energies->write(row);
                          State reached;
                          reached.t = row.t;
                          reached.n = std::llround((row.t - spec.t_start) / spec.h);
                          for (Observer* watching : options.observers) watching->pass(reached);
                        },
                    .stop = &record.stop(),
                    .resumption = {.checkpoints = &keeper, .from = record.rest()}});
  EnsembleOutcome outcome(result);
  if (outcome.interrupted > 0) outcome.message += keeper.why_stopped();
  // Each gets its chance to be whole, also where another one was not.
  const auto attempt = [&](const auto& write) {
    try {
      write();
    } catch (const Error& error) {
      outcome.fail_to_write(error.what());
    }
  };
  if (options.ends) options.ends();
  attempt([&] { energies->commit(); });
  attempt([&] { write_members(folder, members, result, has_modified); });
  attempt([&] { write_finals(folder, problem, result); });
  if (folder.has_lock() && folder.is_at_its_path()) remove_pictures(folder.path());  // drawn while it went on
  const std::string way_on = keeper.way_on(energies->last().t);
  const bool is_said = outcome.interrupted > 0 || !outcome.is_written;
  if (is_said) add_to(outcome.message, way_on);
  const std::string backend =
      spec.backend == "auto" ? std::string(automatic_backend(problem).name) : spec.backend;  // of every member
  const auto summarised = [&] {
    return summary(spec, backend, result, outcome, *energies, has_modified, certificate, options, record);
  };
  attempt([&] { write_file(folder, "summary.json", summarised()); });
  if (outcome.interrupted == 0 && outcome.is_written) remove_checkpoints(folder);
  if (!outcome.is_written && !is_said) add_to(outcome.message, way_on);  // of the summary that could not be written
  return {.outcome = outcome,
          .first = energies->first(),
          .last = energies->last(),
          .members = std::ssize(result.members),
          .wall_seconds = result.wall_seconds,
          .summary = summarised()};
}

}  // namespace

EnsembleCaseResult run_ensemble_case(RunSpec spec, const std::filesystem::path& directory,
                                     const RunCaseOptions& options) {
  spec.output_directory = directory.string();
  return run(std::move(spec), nullptr, options);
}

EnsembleCaseResult resume_ensemble_case(GoingOn from, const RunCaseOptions& options) {
  return run(from.spec, &from, options);
}

}  // namespace seiche
