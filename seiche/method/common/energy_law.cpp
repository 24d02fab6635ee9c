#include <seiche/method/common/energy_law.hpp>

namespace seiche {

std::vector<std::string> energy_law_names() { return {"interval", "guard", "none"}; }

std::string to_string(EnergyLaw law) { return energy_law_names()[static_cast<std::size_t>(law)]; }

}  // namespace seiche
