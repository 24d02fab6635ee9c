// Processes that are threads of one: whatever a run does on several it does without mpiexec, and under sanitizers.
#pragma once

#include <seiche/core/base/error.hpp>
#include <seiche/core/grid/ranks.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace seiche::test {

// body(ranks) on `count` threads. Throws what one of them throws. Where threads make calls that do not belong together,
// or one of them makes none while others wait, Error says what each was about to do.
void on_ranks(int count, const std::function<void(const Ranks&)>& body);

// What was sent from one rank to another, on all ranks together.
struct Traffic {
  std::int64_t messages = 0, bytes = 0, reductions = 0;  // reductions: calls, not counted for each rank
};
Traffic traffic_on_ranks(int count, const std::function<void(const Ranks&)>& body);

}  // namespace seiche::test
