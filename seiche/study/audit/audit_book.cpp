#include <seiche/backend/backends.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/study/audit/audit_book.hpp>

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <utility>

namespace seiche {

void AuditBook::add(std::string claim, Verdict verdict, std::string evidence) {
  audit_.entries.push_back({std::move(claim), verdict, std::move(evidence)});
}

void AuditBook::add_differences(std::string claim, const std::vector<std::string>& differences, std::string agreement) {
  add(std::move(claim), differences.empty() ? Verdict::confirmed : Verdict::contradicted,
      differences.empty() ? std::move(agreement) : fmt::format("{}", fmt::join(differences, "; ")));
}

void AuditBook::compare(std::string claim, double recomputed, double written, double allowed) {
  const double distance = std::abs(recomputed - written);
  add(std::move(claim), distance <= allowed ? Verdict::confirmed : Verdict::contradicted,
      fmt::format("{:.17g} recomputed, {:.17g} in the files: {:.2g} apart, round-off explains {:.2g}", recomputed,
                  written, distance, allowed));
}

void AuditBook::compare_hashes(const std::filesystem::path& directory, const FileHashes& written) {
  const std::string claim = "case.toml is that of the run, by its SHA-256";
  const auto of_case = written.find("case.toml");
  if (of_case == written.end()) return add(claim, Verdict::not_checked, "summary.json has none");
  const std::string now = sha256_of_file(directory / "case.toml");
  add(claim, now == of_case->second ? Verdict::confirmed : Verdict::contradicted,
      now == of_case->second ? now
                             : fmt::format("case.toml has changed: {} in summary.json, {} now", of_case->second, now));
  if (written.size() == 1) return;
  std::vector<std::string> changed, missing;
  for (const auto& [file, hash] : written) {
    if (file == "case.toml") continue;
    if (!complaint_about_file(file).empty()) {
      missing.push_back(shortened_path(file));
    } else if (sha256_of_file(file) != hash) {
      changed.push_back(fmt::format("{} has changed", shortened_path(file)));
    }
  }
  const std::string of_files = "the files that the case names are those of the run, by their SHA-256";
  if (changed.empty() && !missing.empty())
    return add(of_files, Verdict::not_checked, fmt::format("no longer there: {}", fmt::join(missing, ", ")));
  add_differences(of_files, changed, fmt::format("{} of them", written.size() - 1));
}

FileHashes hashes_in(const std::filesystem::path& summary) {
  std::ifstream input(summary);
  const nlohmann::json json = nlohmann::json::parse(input, nullptr, false);
  FileHashes hashes;
  if (!json.is_object() || !json.contains("sha256") || !json["sha256"].is_object()) return hashes;
  for (const auto& [file, hash] : json["sha256"].items())
    if (hash.is_string()) hashes[file] = hash.get<std::string>();
  return hashes;
}

RecomputedEnergy::RecomputedEnergy(const Problem& problem)
    : system_(automatic_backend(problem).system(problem, {})), z_(system_.initial) {}

EnergyTerms RecomputedEnergy::of(const Vector& physical) {
  system_.space->from_physical(physical, z_);
  return system_.energy_terms(z_);
}

}  // namespace seiche
