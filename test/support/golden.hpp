// Access to test/data/golden.json.
#pragma once

#include <test/support/cases.hpp>

#include <seiche/simulation/simulation.hpp>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace seiche::test {

const nlohmann::json& golden_case(const std::string& name);
Vector golden_vector(const nlohmann::json& numbers);

struct GoldenMethod {
  std::string golden_name;  // "SEILM_dir", "SEISAV_literal", …
  std::string method;       // ours
  bool literal = false;
  std::vector<double> step_sizes;
  double C = 1.0;
  nlohmann::json results;  // by step size

  const nlohmann::json& result(double h) const;
  // As the oracle ran it: C as given, plain Newton for the lm family, the auxiliary frozen where it is literal.
  SimulationOptions options(std::string_view backend, ScalarSolver solver = ScalarSolver::newton) const;
};

std::vector<GoldenMethod> golden_methods(const std::string& case_name);

}  // namespace seiche::test
