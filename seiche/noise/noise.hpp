// Thermal noise: what a case asks for.
#pragma once

#include <cstdint>

namespace seiche {

// Noise that balances the dissipation of a problem, so that states are distributed as exp(−H/T): dz = S∇H dt − Dz dt +
// √(2TR) dW, with R∇H = Dz, or with R = −S where S = Sᵀ and D = 0.
struct Noise {
  double temperature = 0.0;  // T ≥ 0, in the units of H, which on a grid is a sum over points; 0: no noise
  std::uint64_t seed = 1;

  bool is_on() const { return temperature > 0; }
  bool operator==(const Noise&) const = default;
};

}  // namespace seiche
