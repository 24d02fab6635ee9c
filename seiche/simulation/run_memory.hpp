// What a run takes, so that what would not fit is refused before anything is allocated.
#pragma once

#include <seiche/core/problem.hpp>
#include <seiche/method/methods.hpp>

#include <string_view>

namespace seiche {

// Bytes of a run, all told (docs/performance.md): on the modal backend, or with the matrices of the sparse one and the
// factors that its propagators keep.
double run_bytes(const MethodEntry& method, const Problem& problem, bool variable_steps = false,
                 std::string_view backend = "modal");

}  // namespace seiche
