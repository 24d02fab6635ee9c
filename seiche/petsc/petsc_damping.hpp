// A constant D that several processes hold together.
#pragma once

#include <seiche/core/damping.hpp>
#include <seiche/petsc/petsc_matrices.hpp>

#include <memory>
#include <string>

namespace seiche {

// Its flow takes one exponential for each row where D is diagonal; otherwise it is that of S = −I, M = D by
// KspResolvents with `prefix`, whose iterations go to round-off. D null: none. D and `space` outlive it.
std::unique_ptr<Damping> petsc_damping(Mat D, const Space& space, Potential::Support support,
                                       const std::string& prefix);

}  // namespace seiche
