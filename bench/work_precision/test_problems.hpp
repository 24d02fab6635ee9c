// The problems of the bench: small, large, stiff, two-dimensional, stiffly damped, one without an energy law, and two
// gradient flows.
#pragma once

#include <bench/peers/equation.hpp>
#include <seiche/core/problem.hpp>

#include <string>
#include <vector>

namespace seiche::bench {

struct TestProblem {
  std::string key;
  std::string title;
  std::string parameters = {};  // everything that decides the solution, initial data in words
  Problem problem = {};
  Equation equation = {};              // the same for peers
  int coarsest = 0;                    // step sizes begin at 2^(−coarsest)
  double reference_tolerance = 1e-14;  // more where round-off in a stiff ż is more
};

std::vector<std::string> test_problem_keys();
TestProblem make_test_problem(const std::string& key);  // throws Error for an unknown key

}  // namespace seiche::bench
