// Newton's method for G(y) = 0 with GMRES on difference quotients of G: the fallback of implicit closures.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/space.hpp>

#include <functional>

namespace seiche {

// x with |b − Ax| ≤ tolerance·|b|, or the best in the Krylov space of `most` products, from x = 0 (Saad, Schultz, SIAM
// J. Sci. Stat. Comput. 7, 1986). Allocates. `apply`: out = Aw.
Vector gmres(const Space& space, FunctionRef<void(const Vector& w, Vector& out)> apply, const Vector& b, int most,
             double tolerance);

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
