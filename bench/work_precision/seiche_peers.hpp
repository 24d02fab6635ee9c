// Seiche's own methods, as runs of the bench.
#pragma once

#include <bench/peers/peer.hpp>
#include <bench/work_precision/test_problems.hpp>

namespace seiche::bench {

// Every method of the list that applies to the problem, on the automatic backend with measured FFTW plans.
std::vector<Peer> seiche_peers(const TestProblem& test);

}  // namespace seiche::bench
