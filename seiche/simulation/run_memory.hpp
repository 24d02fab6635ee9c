// What a run takes, so that what would not fit is refused before anything is allocated.
#pragma once

#include <seiche/backend/backends.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/method/methods.hpp>

namespace seiche {

// Bytes of a run, all told (docs/performance.md).
double run_bytes(const MethodEntry& method, const BackendEntry& backend, const Problem& problem,
                 bool variable_steps = false);

// Of these, those of its Simulation: without the last good state, the problem of the case, and values at points on
// their way to files.
double simulation_bytes(const MethodEntry& method, const BackendEntry& backend, const Problem& problem,
                        bool variable_steps = false);

}  // namespace seiche
