// Loops over blocks of work, shared among threads.
#pragma once

#include <seiche/core/vector.hpp>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace seiche {

// Blocks are cut by the caller and never by the number of threads, so that sums taken block by block, in order, do not
// depend on it. body(block, thread): thread is 0 … threads − 1 among those of this loop, whatever region of the
// caller's own it stands in.
template <class Body>
void for_blocks_by_thread(Index blocks, [[maybe_unused]] int threads, const Body& body) {
#ifdef _OPENMP
  if (threads > 1 && blocks > 1) {
#pragma omp parallel for schedule(static) num_threads(threads)
    for (Index block = 0; block < blocks; ++block) body(block, omp_get_thread_num());
    return;
  }
#endif
  for (Index block = 0; block < blocks; ++block) body(block, 0);
}

template <class Body>
void for_blocks(Index blocks, int threads, const Body& body) {
  for_blocks_by_thread(blocks, threads, [&body](Index block, int) { body(block); });
}

}  // namespace seiche
