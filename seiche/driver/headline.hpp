// The first line of a run: what is about to be solved, and how.
#pragma once

#include <seiche/config/case/run_spec.hpp>
#include <seiche/simulation/simulation.hpp>

#include <string>

namespace seiche {

// "klein_gordon: u, v on 64 × 64 points (periodic), 8192 unknowns; egc4, tolerance 1e-06, backend modal, to t = 50"
std::string headline(const RunSpec& spec, const Simulation& simulation);

}  // namespace seiche
