#include <bench/work_precision/judge.hpp>
#include <seiche/backend/backends.hpp>
#include <seiche/law/law.hpp>

#include <fmt/format.h>

#include <cmath>

namespace seiche::bench {

Judge::Judge(const TestProblem& test)
    : system_(find_backend("modal").system(test.problem, {})),
      law_(promise_energy_law(test.problem, test.equation.t_end)),
      initial_(test.problem.initial),
      coordinates_(system_.space->size()) {}

const Vector& Judge::coordinates(std::span<const double> z) const {
  system_.space->from_physical(Eigen::Map<const Vector>(z.data(), static_cast<Index>(z.size())), coordinates_);
  return coordinates_;
}

double Judge::energy(std::span<const double> z) const { return system_.energy(coordinates(z)); }

double Judge::energy_round_off(std::span<const double> z) const {
  return system_.energy_terms(coordinates(z)).round_off();
}

// Relative to the largest value: the terms of ż are far larger than ż itself where differences divide by Δx³.
double Judge::disagreement(Run& run, const Vector& z) const {
  const std::span<const double> values(z.data(), static_cast<std::size_t>(z.size()));
  Vector theirs(z.size());
  Vector ours(system_.space->size());
  run.right_hand_side(values, {theirs.data(), static_cast<std::size_t>(theirs.size())});
  system_.right_hand_side(0, coordinates(values), ours);
  const Vector expected = system_.space->physical(ours);
  return (theirs - expected).lpNorm<Eigen::Infinity>() / expected.lpNorm<Eigen::Infinity>();
}

std::string Judge::refuses(Run& run) const {
  constexpr double allowed = 1e-9;
  Vector rough = initial_;
  for (Index j = 0; j < rough.size(); ++j)
    rough[j] += 0.1 * std::sin(1.7 * static_cast<double>(j) + 0.3 * static_cast<double>(j % 7));
  for (const Vector& z : {initial_, rough}) {
    const double relative = disagreement(run, z);
    if (!(relative <= allowed))
      return fmt::format("its right-hand side differs from the library's by {:.2g}, and {:.0e} is allowed", relative,
                         allowed);
  }
  return "";
}

}  // namespace seiche::bench
