// The propagator whose force maps are Padé approximations.
#pragma once

#include <seiche/backend/sparse/pade.hpp>
#include <seiche/core/potential.hpp>
#include <seiche/core/propagator.hpp>
#include <seiche/core/space.hpp>

#include <memory>

namespace seiche {

// Q = F(h/2) for the exponential; null for Cayley, where it is F/2. `support`: the components that V depends on, and
// predictors are asked for. M and `space` outlive it.
std::unique_ptr<Propagator> pade_propagator(const Product& M, const Space& space, Potential::Support support,
                                            std::unique_ptr<PadeForce> F, std::unique_ptr<PadeForce> Q);

// The same where S is skew and the resolvents hold to a tolerance only: FMz, and the Ff that follow, are moved within
// their span to where the contract of Propagator holds for all sums of them to round-off. So closures keep their law to
// round-off. `moved`, which outlives it, becomes the largest relative move.
std::unique_ptr<Propagator> restoring_pade_propagator(const Product& M, const Space& space, Potential::Support support,
                                                      std::unique_ptr<PadeForce> F, std::unique_ptr<PadeForce> Q,
                                                      double& moved);

}  // namespace seiche
