// The energy-compatible linear damping condition, the paper's (1.2): ∇H(z)ᵀDz ≥ 0 for every z, so that the damping flow
// never raises H. Written with ∇H = P_H z it is sym(P_H D) ⪰ 0.
//
// ∇HᵀDz = zᵀMDz + ∇V(z)ᵀDz. The first term is ≥ 0 for every z where sym(MD) ⪰ 0, which is decided mode by mode or by
// factorisation (law/operator_findings). The second is not there, or ≥ 0, in the cases that are known here:
//   the paper's (i)    D leaves alone what V depends on: Dᵀ∇V = 0;
//   the paper's (ii)   V = 0;
//   further            D = γI on the fields v of V(u, v) that it moves, γ ≥ 0, and v·∂V/∂v ≥ 0: then it is γ v·∂V/∂v.
// Elsewhere sym(MD) ⪰ 0 alone proves nothing, and a certificate samples ∇HᵀDz along a solution.
#pragma once

#include <seiche/core/base/error.hpp>
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

// The promise by (1.2) once M ⪰ 0, sym(S) ⪯ 0 and sym(MD) ⪰ 0 are known: it fails where the damping may raise V.
LawPromise promise_given_semidefinite_MD(const Problem& problem);

}  // namespace seiche
