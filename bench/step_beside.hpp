// A step of any method on any backend, beside what its memory and its transforms cannot be faster than.
#pragma once

#include <seiche/core/problem.hpp>

#include <string>

namespace seiche::bench {

struct StepBeside {
  double step;             // seconds
  double transform_count;  // of a field of V, in one step; 0: the backend has none
  double transforms;       // seconds of so many, at the speed of going there and back in place
  double triad;            // seconds of a = b + s c over the unknowns of one field
};

// On one thread, with set-up and first step apart. Throws Error where a step fails.
StepBeside measure_step(const Problem& problem, const std::string& method, const std::string& backend, double h);

}  // namespace seiche::bench
