// The reference backend: the two verbs of the linear substep by full matrices, and nothing else. Slow, short, right.
#pragma once

#include <seiche/core/system.hpp>

namespace seiche {

// Potential, damping and φ-functions are those of the dense backend. Throws Error above dense_limit unknowns.
System reference_system(const Problem& problem, const BackendOptions& options = {});

}  // namespace seiche
