// Grids in modal coordinates, where S, M and D are one small block per mode: exact, and a step costs transforms only.
#pragma once

#include <seiche/core/system.hpp>

#include <string>

namespace seiche {

// Throws Error where a first derivative stands on a grid that is not periodic along every axis.
System modal_system(const Problem& given, const BackendOptions& options = {});

// Bytes of the problem, the modes of its parts, the values at its points and the outputs of a run.
double modal_bytes(const Problem& problem, double factored);

}  // namespace seiche
