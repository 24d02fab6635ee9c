// Grids in modal coordinates, where S, M and D are one small block per mode: exact, and a step costs transforms only.
#pragma once

#include <seiche/core/system.hpp>

#include <string>

namespace seiche {

// Throws Error where a stencil that is not symmetric meets a Dirichlet end: sines do not diagonalise it.
System modal_system(const Problem& problem, const BackendOptions& options = {});

}  // namespace seiche
