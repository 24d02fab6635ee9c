// What a step that ends with a projection promises of H.
#pragma once

#include <string>
#include <vector>

namespace seiche {

enum class EnergyLaw {
  interval,  // H falls by what the damping takes, as far as two quadratures of it agree, and never rises
  guard,     // H never rises, and stays where nothing dissipates
  none,      // nothing: the step ends where the scheme without projection does
};

std::string to_string(EnergyLaw law);
std::vector<std::string> energy_law_names();

}  // namespace seiche
