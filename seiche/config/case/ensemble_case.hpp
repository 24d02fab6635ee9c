// What [ensemble] says: how many members, and in what they differ.
#pragma once

#include <seiche/config/data/case_value.hpp>
#include <seiche/problem/problems.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace seiche {

// The values of one parameter over the members.
struct ParameterSamples {
  enum class Kind { range, uniform, normal };
  Kind kind = Kind::range;
  double a = 0.0, b = 0.0;  // from and to; the ends of the interval; mean and standard deviation
  bool operator==(const ParameterSamples&) const = default;
};

struct EnsembleSpec {
  std::int64_t members = 0;  // 0: as many as there are files
  std::uint64_t seed = 1;
  std::vector<std::filesystem::path> files;  // absolute; initial states, one for each member; none: that of [problem]
  double perturb_initial = 0.0;              // standard deviation of what is added to every value of z₀
  std::vector<std::pair<std::string, ParameterSamples>> parameters;  // in the order of the case

  std::int64_t count() const { return members > 0 ? members : static_cast<std::int64_t>(files.size()); }
  bool operator==(const EnsembleSpec&) const = default;
};

// Is it one number, which [ensemble] may give every member anew?
bool may_vary(const Parameter& parameter);

// Reads the value of a key of [ensemble]: one of its own, or a parameter of the problem that may vary. Throws Error
// with a sentence that names the key, the value and what is allowed.
void read_ensemble_key(EnsembleSpec& ensemble, const std::string& name, const CaseValue& value,
                       const ProblemEntry& problem, const std::filesystem::path& folder);

// One sentence where the keys do not fit together, else "". `noisy`: members differ by their noise.
std::string ensemble_complaint(const EnsembleSpec& ensemble, bool noisy);

std::string write_ensemble(const EnsembleSpec& ensemble);  // the section as a case file has it

}  // namespace seiche
