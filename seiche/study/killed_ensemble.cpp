#include <seiche/backend/backends.hpp>
#include <seiche/core/error.hpp>
#include <seiche/output/csv_table.hpp>
#include <seiche/simulation/simulation.hpp>
#include <seiche/study/killed_ensemble.hpp>
#include <seiche/study/versions.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace seiche {
namespace {

using Json = nlohmann::ordered_json;

// Null where energy.csv has no such columns, and for what is not finite.
Json statistics_of(const CsvTable& energies, const std::string& energy, bool last) {
  Json found;
  for (const char* name : {"mean", "sd", "min", "q05", "median", "q95", "max"}) {
    const std::string column = fmt::format("{}_{}", energy, name);
    if (!energies.has(column)) return nullptr;
    const std::vector<double> values = energies.column(column);
    const double value = last ? values.back() : values.front();
    found[name] = std::isfinite(value) ? Json(value) : Json(nullptr);
  }
  return found;
}

Json first_and_last(const CsvTable& energies, const std::string& energy) {
  return {{"initial", statistics_of(energies, energy, false)}, {"final", statistics_of(energies, energy, true)}};
}

}  // namespace

MemberCounts count_members(const TextTable& members) {
  MemberCounts counts;
  for (std::size_t m = 0; m < members.rows(); ++m) {
    const std::string& status = members.text(m, "status");
    const std::string& law = members.text(m, "law");
    ++counts.statuses[status];
    if (law != "holds" || status != "failed") ++counts.laws[law];  // kept up to a failure is not kept
    counts.steps += static_cast<std::int64_t>(members.number(m, "steps"));
  }
  return counts;
}

std::string summary_of_killed_ensemble(const std::filesystem::path& directory, const RunSpec& spec) {
  const CsvTable energies = CsvTable::read(directory / "energy.csv");
  const double t = energies.column("t").back();
  Json energy = first_and_last(energies, "H");
  energy["modified"] = energies.has("H_modified_mean") ? first_and_last(energies, "H_modified") : Json(nullptr);
  energy["law"] = nullptr;
  Json json = {{"status", "unfinished"},
               {"message",
                fmt::format("the ensemble ended, killed or without a disk to write to, before its files were "
                            "whole; `seiche recover` found statistics up to t = {:.9g} of {:.9g}",
                            t, spec.t_end)},
               {"problem", spec.problem},
               {"method", spec.method},
               {"backend",
                spec.backend == "auto" ? std::string(automatic_backend(make_problem(spec)).name) : spec.backend},
               {"h", spec.h},
               {"members", spec.ensemble->count()},
               {"statuses", nullptr},
               {"laws", nullptr},
               {"steps", nullptr},
               {"t", t},
               {"energy", energy},
               {"counts", nullptr},  // not known
               {"wall_seconds", nullptr},
               {"versions", versions_in_use()}};
  if (const std::filesystem::path file = directory / "members.csv"; std::filesystem::exists(file)) {
    MemberCounts counts = count_members(TextTable(file));
    for (const char* status : {"success", "failed", "interrupted"}) json["statuses"][status] = counts.statuses[status];
    for (const char* law : {"holds", "violated", "not promised"}) json["laws"][law] = counts.laws[law];
    json["steps"] = counts.steps;
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace seiche
