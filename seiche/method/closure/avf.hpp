// Averaged vector field closure: f = ∫₀¹ ∇V(z + s(z⁺ − z)) ds (Celledoni et al. 2012; Liu et al. 2021).
#pragma once

#include <seiche/method/closure/closure.hpp>
#include <seiche/method/common/method_options.hpp>

#include <memory>

namespace seiche {

// Keeps H exactly in the Hamiltonian substep. Implicit: fixed point with the linear part inside, then Newton–Krylov
// where that does not contract; a step that neither solves fails.
std::unique_ptr<Closure> make_avf_closure(const System& system, const MethodOptions& options);

}  // namespace seiche
