// The problems that properties run over: the paper's examples and what lies around them.
#pragma once

#include <seiche/backend/backends.hpp>
#include <seiche/core/problem.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace seiche::test {

Problem klein_gordon_case(double gamma = 0.1, double alpha = -1.0);
Problem fpu_conservative_case(double gamma = 0.5, double beta = 0.01);
Problem fpu_dissipative_case(double gamma = 0.5, double beta = 0.01);
Problem gkdv_case(double mu = 0.5, double sigma = 0.001, double amplitude = 0.4);
Problem duffing_case(double gamma = 0.1);

struct NamedProblem {
  std::string name;
  Problem problem;
};

// The paper's four cases, by the names that golden.json has for them.
std::vector<NamedProblem> golden_cases();
// Small grids of every dimension, boundary and discretisation.
std::vector<NamedProblem> grid_cases();
// Masses in a row, with dashpots.
std::vector<NamedProblem> chain_cases();
// γ(x) and γ(x, t).
std::vector<NamedProblem> field_rate_cases();
// Coefficients that change from point to point, and graphs: stated by matrices.
std::vector<NamedProblem> matrix_cases();
// Friction beyond linear, external forces, structure matrices that change with the state.
std::vector<NamedProblem> beyond_linear_cases();
// Phases that part, and patterns of one wavelength: S ⪯ 0.
std::vector<NamedProblem> gradient_flow_cases();
// Energies, structure and damping by formulas.
std::vector<NamedProblem> written_cases();
// Every problem that each method is to be tried on: all of the above and a few more.
std::vector<NamedProblem> all_cases();

// True if the method applies (whole methods need the damping in S, splitting ones a constant S).
bool applies(std::string_view method, const Problem& problem);
// The backends that take it: modal no matrices, sparse no spectral derivatives.
std::vector<BackendEntry> backends_for(const Problem& problem);
// The same without "reference", whose long double takes as long as all others together.
std::vector<BackendEntry> quick_backends_for(const Problem& problem);

}  // namespace seiche::test
