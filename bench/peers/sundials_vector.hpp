// SUNDIALS' serial vectors with our own loops. Debian compiles SUNDIALS without optimisation; what costs time per grid
// point are the vector operations, and replacing those in the table of a vector is what the table is there for.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include <memory>
#include <vector>

namespace seiche::bench {

struct FreeVector {
  void operator()(N_Vector v) const { N_VDestroy(v); }
};
using SundialsVector = std::unique_ptr<_generic_N_Vector, FreeVector>;

SundialsVector make_vector(const std::vector<double>& values, SUNContext context);  // a copy

// Time of the packaged N_VLinearSum over that of our loop, for vectors that stay in the cache.
double packaged_vector_slowdown();

}  // namespace seiche::bench
