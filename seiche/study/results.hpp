// What studies measure, as plain data.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace seiche {

// One method at one step size against the reference.
struct StudyRow {
  std::string method;
  double h = 0.0;
  double error = 0.0;                  // max_n ‖zⁿ − z(tₙ)‖_∞, physical values
  double energy_error = 0.0;           // max_n |H(zⁿ) − H(z(tₙ))|
  double max_energy_increase = 0.0;    // max_n H(zⁿ⁺¹) − H(zⁿ)
  double max_modified_increase = 0.0;  // the same of the method's own energy
  std::optional<double> order;         // against the next larger h of the same method
  long long steps = 0;
  long long scalar_iterations = 0;
  long long fallbacks = 0;
  long long replaced = 0;  // steps that found no solution
  long long unresolved = 0;
  double cpu_seconds = 0.0;      // median of repeated runs after a warm-up, stepping only
  bool energy_law_held = false;  // no recorded step raised the method's energy beyond round-off
  std::string failure;           // "" if the run reached the end
};

// A function of time, thinned for drawing.
struct Curve {
  std::string name;
  std::vector<double> t;
  std::vector<double> value;
};

}  // namespace seiche
