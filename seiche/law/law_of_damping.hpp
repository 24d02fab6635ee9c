// What stencils and matrices have in common when they ask whether damping lets H fall.
#pragma once

#include <seiche/core/error.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/law/law.hpp>

#include <string>

namespace seiche {

// A sentence where γ is negative at some time up to t_end, else "". `rate`: a Rate or a FieldRate, or null.
template <class AnyRate>
std::string complaint_about_rate(const AnyRate* rate, double t_end) {
  const double t = rate != nullptr ? rate->first_negative_time(t_end) : -1.0;
  return t >= 0 ? fmt::format("the rate {} is negative at t = {:.6g}", rate->text(), t) : "";
}

// What stands against a law beside S, M and D: friction that feeds, external forces. A sentence, or "".
std::string complaint_beyond_linear(const Problem& problem, double t_end);

// The last question, once M ⪰ 0, sym(S) ⪯ 0 and sym(MD) ⪰ 0 are known: may the damping raise V?
LawPromise promise_given_semidefinite_MD(const Problem& problem);

}  // namespace seiche
