// Lagrange multiplier closure: f = η∇V(ẑ) with V(z⁺) − V(z) = η∇V(ẑ)ᵀ(z⁺ − z) (paper (3.6), Algorithms 2 and 4; Cheng,
// Liu, Shen 2020).
#pragma once

#include <seiche/method/closure/closure.hpp>
#include <seiche/method/common/method_options.hpp>

#include <memory>

namespace seiche {

// Keeps H exactly in the Hamiltonian substep wherever η is found. `robust` leaves the multiplier for the directed one
// where its equation is ill-conditioned; `newton` is the paper's iteration, which counts what it cannot resolve.
std::unique_ptr<Closure> make_lm_closure(const System& system, const MethodOptions& options);

}  // namespace seiche
