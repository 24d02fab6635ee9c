// H step by step.
#pragma once

#include <seiche/simulation/simulation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace seiche::test {

// Every one of so many steps is solved, and in none of them H rises beyond round-off.
inline void expect_falling_energy(Simulation& simulation, double h, int steps, const std::string& label = "") {
  EnergyReading before = simulation.energy();
  for (int n = 0; n < steps; ++n) {
    ASSERT_TRUE(simulation.step(h).solved()) << label << " h = " << h;
    const EnergyReading after = simulation.energy();
    EXPECT_LE(after.H - before.H, std::max(before.round_off, after.round_off)) << label << " h = " << h;
    before = after;
  }
}

}  // namespace seiche::test
