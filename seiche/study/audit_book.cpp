#include <seiche/backend/backends.hpp>
#include <seiche/study/audit_book.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
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

RecomputedEnergy::RecomputedEnergy(const Problem& problem)
    : system_(automatic_backend(problem).system(problem, {})), z_(system_.initial) {}

EnergyTerms RecomputedEnergy::of(const Vector& physical) {
  system_.space->from_physical(physical, z_);
  return system_.energy_terms(z_);
}

double largest_increase(const std::vector<double>& values) {
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double increase = values[i] - values[i - 1];
    if (std::isnan(increase)) return increase;
    largest = std::max(largest, increase);
  }
  return values.size() > 1 ? largest : 0.0;
}

}  // namespace seiche
