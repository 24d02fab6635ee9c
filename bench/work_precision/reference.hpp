// The solution at T, from two integrators that share nothing but the equation.
#pragma once

#include <bench/work_precision/judge.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace seiche::bench {

struct Reference {
  std::vector<double> z;  // at T
  double energy = 0.0;
  double difference = 0.0;  // between the two, max-norm: what an error below it says is about the reference
  std::string origin;
};

// Read from `directory` if it was computed there for the same parameters and initial data, computed and kept otherwise.
// Throws Error where the two integrators disagree.
Reference find_reference(const TestProblem& test, const Judge& judge, const std::filesystem::path& directory);

}  // namespace seiche::bench
