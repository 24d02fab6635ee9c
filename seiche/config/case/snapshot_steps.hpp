// A time between snapshots, where steps are of one size.
#pragma once

#include <seiche/config/case/case_value.hpp>

#include <cstdint>
#include <string>

namespace seiche {

// How many steps of h > 0 the interval > 0 takes. Throws Error, with the nearest number of steps, where it is no
// multiple of h: steps of one size come to no other times than theirs.
std::int64_t steps_between_snapshots(const std::string& key, const CaseValue& interval, double h);

}  // namespace seiche
