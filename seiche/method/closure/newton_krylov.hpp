// Newton's method for G(y) = 0 with GMRES on difference quotients of G: the fallback of implicit closures.
#pragma once

#include <seiche/core/space.hpp>

#include <functional>

namespace seiche {

struct NewtonKrylovReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0.0;  // in units of the tolerance
};

// out = G(y); returns |G(y)| in units of the tolerance.
using Residual = std::function<double(const Vector& y, Vector& out)>;

// Improves y until |G(y)| ≤ 1, or until it stops falling below `stagnation`. Allocates.
NewtonKrylovReport newton_krylov(const Space& space, const Residual& residual, Vector& y, double stagnation);

}  // namespace seiche
