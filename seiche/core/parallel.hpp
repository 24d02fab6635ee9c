// Loops over blocks of work, shared among threads.
#pragma once

#include <seiche/core/vector.hpp>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace seiche {

// Of the thread that runs a block: 0 … threads − 1.
inline int thread_number() {
#ifdef _OPENMP
  return omp_get_thread_num();
#else
  return 0;
#endif
}

// Blocks are cut by the caller and never by the number of threads, so that sums taken block by block, in order, do not
// depend on it.
template <class Body>
void for_blocks(Index blocks, [[maybe_unused]] int threads, const Body& body) {
#ifdef _OPENMP
  if (threads > 1 && blocks > 1) {
#pragma omp parallel for schedule(static) num_threads(threads)
    for (Index block = 0; block < blocks; ++block) body(block);
    return;
  }
#endif
  for (Index block = 0; block < blocks; ++block) body(block);
}

}  // namespace seiche
