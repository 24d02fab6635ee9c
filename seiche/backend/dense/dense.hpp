// Full matrices in physical coordinates, in as few passes as there can be: for systems of few unknowns.
#pragma once

#include <seiche/core/system.hpp>

namespace seiche {

// Throws Error above dense_limit unknowns, where the matrices alone would take gigabytes.
inline constexpr Index dense_limit = 4096;
System dense_system(const Problem& problem, const BackendOptions& options = {});

}  // namespace seiche
