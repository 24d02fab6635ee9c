// The energy law that a run promises, before it and after.
#pragma once

#include <seiche/config/run_spec.hpp>
#include <seiche/core/run_report.hpp>

#include <string>

namespace seiche::cli {

// What one member of an ensemble promises, unless an option of the method gives it up; a run quotes its certificate.
LawPromise promise(const Simulation& simulation, const RunSpec& spec);

// Why the promise is withdrawn after the run, or "": γ ≥ 0 was sampled before it, and the run itself looks closer.
std::string negative_rate(const Problem& problem);

}  // namespace seiche::cli
