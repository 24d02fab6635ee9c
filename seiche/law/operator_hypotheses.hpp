// The part of a certificate that depends on S, M and D alone.
#pragma once

#include <seiche/core/problem.hpp>
#include <seiche/law/hypothesis.hpp>
#include <seiche/law/operator_findings.hpp>

namespace seiche {

// sym(S) ⪯ 0, by structure if S is skew
Hypothesis hypothesis_of_S(const Problem& problem, const OperatorFindings& findings);
// M ⪰ 0, its kernel named
Hypothesis hypothesis_of_M(const Problem& problem, const OperatorFindings& findings);
// sym(MD) ⪰ 0, for the constant part of D and for the projector of its rate
Hypothesis hypothesis_of_MD(const Problem& problem, const OperatorFindings& findings);
Hypothesis hypothesis_of_commuting(const Problem& problem);  // D(t)D(s) = D(s)D(t)

}  // namespace seiche
