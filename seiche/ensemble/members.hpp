// The members that a case file asks for.
#pragma once

#include <seiche/config/case/run_spec.hpp>
#include <seiche/ensemble/member_block.hpp>

#include <string>
#include <vector>

namespace seiche {

struct Members {
  std::vector<EnsembleMember> list;
  std::vector<std::string> parameters;      // that vary, in the order of the case
  std::vector<std::vector<double>> values;  // of these, for every member
};

// Member by member, one after the other from one generator (std::mt19937_64 from the seed): parameters first, then what
// is added to z₀. More members with the same seed begin with the same ones. Ranges of several parameters run together.
// Uniform and normal numbers are made here, since the standard leaves the distributions of its library open.
// Throws Error with the member where a sample is out of bounds or a file does not fit, and before any is made where
// their ensemble_bytes are more than there are.
Members make_members(const RunSpec& spec);

// What the ensemble takes in memory: states for every member, and a simulation for every one where parameters vary.
double ensemble_bytes(const RunSpec& spec);

}  // namespace seiche
