// Members of ensembles that several tests look at.
#pragma once

#include <seiche/damping/rates.hpp>
#include <seiche/ensemble/member_block.hpp>
#include <seiche/problem/sparse.hpp>

#include <memory>
#include <vector>

namespace seiche::test {

// Three, one after the other in γ. At γ = −4.25 and h = 0.5 the Cayley propagator of `sav` divides by zero.
inline std::vector<EnsembleMember> one_without_a_propagator() {
  SparseMatrix M(2, 2);
  M.setIdentity();
  std::vector<EnsembleMember> members;
  for (const double gamma : {0.1, -4.25, 0.2}) {
    auto problem = std::make_shared<const Problem>(
        sparse_problem({.matrices = {.S = {}, .M = M, .D = {}}, .quartic = 1.0, .gamma = constant_rate(gamma)}));
    members.push_back({problem, problem->initial});
  }
  return members;
}

}  // namespace seiche::test
