// What round-off of the state itself does to H. Where a state rests and terms of V cancel, all that is left of H is of
// this size.
#pragma once

#include <seiche/core/run_report.hpp>
#include <seiche/core/system.hpp>

#include <cstdint>

namespace seiche {

// Does round-off of physical values, gathered over so many steps, change H as much as this drift?
bool is_round_off_of_state(const EnergyDrift& drift, const System& system, const Vector& values, std::int64_t steps);

}  // namespace seiche
