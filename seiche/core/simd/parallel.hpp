// Loops over blocks of work, shared among threads.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/simd/thread_team.hpp>

namespace seiche {

// Blocks are cut by the caller and never by the number of threads, so that sums taken block by block, in order, do not
// depend on it. body(block, thread): thread is 0 … threads − 1 among those of this loop.
template <class Body>
void for_blocks_by_thread(Index blocks, int threads, const Body& body) {
  if (threads > 1 && blocks > 1 && blocks <= ThreadTeam::most_blocks && !ThreadTeam::is_in_a_block())
    return ThreadTeam::of_caller(threads).run(blocks, body);
  for (Index block = 0; block < blocks; ++block) body(block, 0);
}

template <class Body>
void for_blocks(Index blocks, int threads, const Body& body) {
  for_blocks_by_thread(blocks, threads, [&body](Index block, int) { body(block); });
}

}  // namespace seiche
