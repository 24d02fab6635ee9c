// Do explicit kicks suit the step size?
#pragma once

#include <seiche/config/simulation.hpp>

#include <string>

namespace seiche {

// What to say before a run with steps of one size h whose method kicks by all forces, where h is beyond the stability of the scheme
// at the fastest rate of the linear part (which is known from below); else "".
std::string beyond_stability(const Simulation& simulation, double h);

}  // namespace seiche
