// How many threads may be asked for.
#pragma once

#include <string>

namespace seiche {

inline constexpr int most_threads = 1024;  // each takes a stack

// Throws Error above most_threads.
void require_thread_count(int threads);
// What to say of so many that they take turns on the cores of this machine, else "".
std::string note_on_threads(int threads);

}  // namespace seiche
