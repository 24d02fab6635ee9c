// S and M mode by mode.
#pragma once

#include <seiche/core/linear_part.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/core/space.hpp>

#include <memory>

namespace seiche {

// `space` outlives it, and adds up what each process knows of the modes that it holds.
std::unique_ptr<LinearPart> modal_linear_part(const Problem& problem, const Space& space, int threads);

}  // namespace seiche
