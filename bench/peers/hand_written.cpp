#include <bench/peers/hand_written.hpp>

#include <fftw3.h>

namespace seiche::bench {

PeerGroup hand_written_peers() {
  constexpr auto origin = Origin::hand_written;
  constexpr auto sweep = Sweep::step_size;
  const std::string own = "hand-written";
  PeerGroup group{.library = {.name = "FFTW", .version = fftw_version, .note = "plans measured, in set-up"},
                  .peers = {{"ETDRK4", own, origin, sweep, any_equation, make_etdrk4},
                            {"Strang exact flow", own, origin, sweep, no_gradient_flow, make_strang},
                            {"projected Strang exact flow", own, origin, sweep, wave_on_a_line, make_projected_strang},
                            {"semi-implicit BDF2", own, origin, sweep, gradient_flow, make_semi_implicit}}};
  for (const auto& more : {rkn_peers(), relaxation_peers()})
    for (const Peer& peer : more) group.peers.push_back(peer);
  return group;
}

}  // namespace seiche::bench
