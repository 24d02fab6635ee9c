// The part of a certificate that depends on S, M and D alone.
#pragma once

#include <seiche/core/finding.hpp>
#include <seiche/core/problem.hpp>

namespace seiche {

Finding finding_of_S(const Problem& problem);  // sym(S) ⪯ 0, by structure if S is skew
Finding finding_of_M(const Problem& problem);  // M ⪰ 0, its kernel named
Finding finding_of_MD(
    const Problem& problem);  // sym(MD) ⪰ 0, for the constant part of D and for the projector of its rate
Finding finding_of_commuting(const Problem& problem);  // D(t)D(s) = D(s)D(t)

}  // namespace seiche
