// The tables of index.html.
#pragma once

#include <bench/work_precision/reach.hpp>

#include <string>
#include <vector>

namespace seiche::bench {

// The fastest of Seiche's methods, of the packaged and of the hand-written integrators, per problem and error.
std::string summary_table(const std::vector<ProblemResult>& results);
std::string reach_table(const ProblemResult& result);  // every integrator
std::string run_table(const ProblemResult& result);    // every run

}  // namespace seiche::bench
