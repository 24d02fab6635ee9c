// Seiche's own methods, as runs of the bench.
#pragma once

#include <bench/peers/peer.hpp>
#include <bench/work_precision/test_problems.hpp>

namespace seiche::bench {

// "egc6": steps of one size. "crkn6 explicit": with linear = "explicit". "egc6 by tolerance", "auto by tolerance":
// variable steps.
std::vector<std::string> seiche_peer_names();

// Those that apply to the problem, on the automatic backend with measured FFTW plans.
std::vector<Peer> seiche_peers(const TestProblem& test);

}  // namespace seiche::bench
