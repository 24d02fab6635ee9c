#include <seiche/config/case/snapshot_steps.hpp>
#include <seiche/core/error.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {

std::int64_t steps_between_snapshots(const std::string& key, const CaseValue& interval, double h) {
  constexpr double round_off = 1e-9;
  const double time = read_number(key, interval);
  const double every = std::max(1.0, std::round(time / h));
  if (std::abs(time - every * h) > round_off * time)
    throw Error("{} = {} is no multiple of h = {}: write snapshot_every = {}, for one every {}, or another h", key,
                interval.shown(), h, every, every * h);
  return static_cast<std::int64_t>(every);
}

}  // namespace seiche
