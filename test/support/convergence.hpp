// Errors of a method against an independent reference, and the order they show.
#pragma once

#include <seiche/simulation/simulation.hpp>
#include <seiche/study/reference.hpp>

#include <string>
#include <vector>

namespace seiche::test {

struct Errors {
  double solution = 0.0;  // max_n ‖zⁿ − z(tₙ)‖_∞
  double energy = 0.0;    // max_n |H(zⁿ) − H(z(tₙ))|
  long long unresolved = 0;
  std::string failure;
};

// Runs to the end of `reference`, which holds every time n h.
Errors errors_against(const Reference& reference, const Problem& problem, const SimulationOptions& options, double h);

// Slope of log error over log h by least squares; errors at round-off are left out.
double fitted_order(const std::vector<double>& h, const std::vector<double>& error);

std::string table(const std::vector<double>& h, const std::vector<double>& error);

}  // namespace seiche::test
