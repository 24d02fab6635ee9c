// Times that can be compared although the machine has other things to do.
#pragma once

#include <functional>
#include <vector>

namespace seiche::bench {

// Median CPU seconds of each contestant, over rounds in which all take turns.
std::vector<double> median_seconds(const std::vector<std::function<void()>>& contestants);

}  // namespace seiche::bench
