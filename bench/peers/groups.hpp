// One function per library. Which of them exist, CMake decides by what it finds; peers() collects those.
#pragma once

#include <bench/peers/peer.hpp>

namespace seiche::bench {

PeerGroup odeint_peers();
PeerGroup gsl_peers();
PeerGroup sundials_peers();

std::vector<PeerGroup> peer_groups();
std::vector<std::string> missing_peer_libraries();  // with the Debian package that has them
std::string peer_compiler_flags();

}  // namespace seiche::bench
