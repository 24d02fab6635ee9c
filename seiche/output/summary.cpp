#include <seiche/output/summary.hpp>

#include <fmt/chrono.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <ctime>

namespace seiche {
namespace {

using Json = nlohmann::ordered_json;  // the order of the keys is the order of reading

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json energy_json(const EnergySummary& energy) {
  return {{"initial", number(energy.initial)},
          {"final", number(energy.final)},
          {"max_increase", number(energy.max_increase)}};
}

}  // namespace

std::string resumed_json(const std::vector<ResumedWith>& all) {
  Json found = Json::object();
  for (const ResumedWith& resumed : all) {
    Json settings = Json::object();
    if (resumed.end) settings["time.end"] = number(*resumed.end);
    found["resumed_at"].push_back(number(resumed.t));
    found["resumed_with"].push_back({{"t", number(resumed.t)}, {"versions", resumed.versions}, {"settings", settings}});
  }
  return found.dump();
}

std::string summary_json(const RunIdentity& run, const RunReport& report) {
  Json energy = energy_json(report.energy);
  energy["modified"] = report.has_modified_energy ? energy_json(report.modified) : Json(nullptr);
  energy["law"] = to_string(report.law);

  Json versions = Json::object();
  for (const auto& [name, version] : run.versions) versions[name] = version;

  Json summary = {{"status", to_string(report.status)},
                  {"message", report.message},
                  {"problem", run.problem},
                  {"method", run.method},
                  {"backend", run.backend},
                  {"h", number(run.h)},
                  {"steps", report.steps},
                  {"t", number(report.t)},
                  {"energy", energy},
                  {"counts",
                   {{"gradients", report.potential_counts.gradients},
                    {"potentials", report.potential_counts.values},
                    {"scalar_iterations", report.scalar_iterations},
                    {"fallbacks", report.fallbacks},
                    {"replaced", report.replaced.count},
                    {"widened", report.widened},
                    {"halved", report.halved}}},
                  {"wall_seconds", number(report.wall_seconds)},
                  {"finished", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(run.finished))},
                  {"versions", versions}};
  if (report.solver)
    summary["solver"] = {{"iterations", report.solver->iterations}, {"restored", number(report.solver->restored)}};
  if (run.threads > 0) summary["threads"] = run.threads;
  if (run.processes > 1) summary["processes"] = run.processes;
  if (!run.hashes.empty()) summary["sha256"] = run.hashes;
  if (!run.resumed_with.empty()) summary.update(Json::parse(resumed_json(run.resumed_with)));
  if (!run.certificate.empty()) summary["certificate"] = Json::parse(run.certificate);
  if (run.tolerance) {
    summary["tolerance"] = number(*run.tolerance);
    summary["counts"]["rejected_steps"] = report.rejected;
  }
  // Bytes of a file name that are no UTF-8 must not turn a report into an exception.
  return summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace seiche
