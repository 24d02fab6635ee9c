// The sparse backend: physical coordinates, coefficients that may change from point to point, any graph.
#pragma once

#include <seiche/core/system.hpp>

namespace seiche {

// Takes problems stated by matrices, or by stencils of finite differences. Throws Error where derivatives are spectral,
// or the options do not fit.
System sparse_system(const Problem& problem, const BackendOptions& options);

}  // namespace seiche
