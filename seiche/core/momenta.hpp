// Which fields of a problem are momenta.
#pragma once

#include <seiche/core/problem.hpp>

#include <optional>

namespace seiche {

// z = (q, p) with q̇ = ∂H/∂p = v = wp and ṗ = −∂H/∂q: the second half of the fields, with w times the identity for
// their block of M and S = [[0, I], [−I, 0]].
struct Momenta {
  Index first = 0;            // field of p
  Index count = 0;            // fields of p, and of q
  double inverse_mass = 1.0;  // w
};

std::optional<Momenta> momenta(const Problem& problem);  // nothing where the problem has another form

}  // namespace seiche
