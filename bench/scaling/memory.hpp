// What a run takes of the machine's memory, measured in a process of its own.
#pragma once

#include <seiche/core/base/vector.hpp>

namespace seiche::bench {

// Peak resident bytes of a run of two steps of seisav on so many points in one dimension, with what the program itself
// holds. Throws Error where the run fails, or asks for more than `limit` bytes. Call it while this process is small:
// the other one begins as its copy.
double peak_bytes(Index points, double limit);

// A part of what is free now, so that other programs keep theirs.
double spare_memory();

}  // namespace seiche::bench
