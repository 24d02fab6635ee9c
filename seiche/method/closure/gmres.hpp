// Linear equations whose matrix is known by its products alone.
#pragma once

#include <seiche/core/function_ref.hpp>
#include <seiche/core/space.hpp>

namespace seiche {

// x with |b − Ax| ≤ tolerance·|b|, or the best in the Krylov space of `most` products, from x = 0 (Saad, Schultz, SIAM
// J. Sci. Stat. Comput. 7, 1986). Allocates. `apply`: out = Aw.
Vector gmres(const Space& space, FunctionRef<void(const Vector& w, Vector& out)> apply, const Vector& b, int most,
             double tolerance);

}  // namespace seiche
