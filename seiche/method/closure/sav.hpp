// Scalar auxiliary variable closure (paper (3.1), Algorithms 1 and 3; Shen, Xu, Yang 2018).
#pragma once

#include <seiche/method/closure/closure.hpp>
#include <seiche/method/common/method_options.hpp>

#include <memory>

namespace seiche {

// Keeps H̃ = ½zᵀMz + r² − C exactly in the Hamiltonian substep (lets it fall if sym(S) ⪯ 0). `begin` throws Error if a
// given C leaves V(z₀) + C ≤ 0.
std::unique_ptr<Closure> make_sav_closure(const System& system, const MethodOptions& options);

}  // namespace seiche
