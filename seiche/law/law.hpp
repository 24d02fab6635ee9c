// Which energy law a problem promises, judged from its structure alone.
#pragma once

#include <seiche/core/problem.hpp>
#include <seiche/core/run_report.hpp>
#include <seiche/law/operator_findings.hpp>

#include <string>

namespace seiche {

// Whether H never grows along exact solutions on [0, t_end], and with it the energy of every method. Needs M ⪰ 0,
// sym(S) ⪯ 0 and the energy-compatible damping condition sym(P_H D) ⪰ 0 (paper (1.2)); each is decided mode by mode
// from the stencils and from the form of V.
LawPromise promise_energy_law(const Problem& problem, double t_end);
// The same from what was seen before: the one place where findings become a promise.
LawPromise promise_energy_law(const Problem& problem, double t_end, const OperatorFindings& findings);

// Throws Error where a rate is infinite at some time of [t_start, t_end], which is named: damping has no flow across
// it, and stages that straddle that time see nothing of it.
void require_finite_rates(const Problem& problem, double t_start, double t_end);

// Why the promise is withdrawn after the run, or "": γ ≥ 0 was sampled before it, and the run itself looks closer.
std::string negative_rate(const Problem& problem);

}  // namespace seiche
