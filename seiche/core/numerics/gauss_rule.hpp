// Gauss–Legendre quadrature on [0, 1].
#pragma once

#include <vector>

namespace seiche {

struct GaussNode {
  double place, weight;
};

// n ≥ 0 nodes, increasing: exact for polynomials of degree 2n − 1.
std::vector<GaussNode> gauss_rule(int n);

}  // namespace seiche
