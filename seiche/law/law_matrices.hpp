// The energy law of problems stated by sparse matrices.
#pragma once

#include <seiche/core/problem.hpp>
#include <seiche/core/run_report.hpp>
#include <seiche/law/operator_findings.hpp>

namespace seiche {

// promise_energy_law where problem.matrices is set: M ⪰ 0, sym(S) ⪯ 0 and sym(MD) ⪰ 0 by factorisation.
LawPromise promise_energy_law_of_matrices(const Problem& problem, double t_end, const OperatorFindings& findings);

}  // namespace seiche
