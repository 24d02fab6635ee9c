// Codes written by hand for one equation: fast, and but for those that project or relax without any promise about the
// energy.
#pragma once

#include <bench/peers/peer.hpp>

namespace seiche::bench {

std::unique_ptr<Run> make_etdrk4(const Equation& equation, double h);
std::unique_ptr<Run> make_strang(const Equation& equation, double h);  // exact damped linear flow, kicks
// The same, each step ending at the energy that its flow has left: what the law costs beside the splitting.
std::unique_ptr<Run> make_projected_strang(const Equation& equation, double h);
std::unique_ptr<Run> make_semi_implicit(const Equation& equation, double h);  // of gradient flows
// Runge–Kutta–Nyström splitting: "kicks" takes the whole force by differences as a kick, explicit; "exact flow" the
// damped linear part exactly.
std::vector<Peer> rkn_peers();

// Explicit Runge–Kutta steps that lower H by the quadrature of its dissipation.
std::vector<Peer> relaxation_peers();

PeerGroup hand_written_peers();

}  // namespace seiche::bench
