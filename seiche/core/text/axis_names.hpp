// What the axes of a grid are called, and the distances of its points along them.
#pragma once

#include <array>

namespace seiche {

inline constexpr std::array axis_names = {"x", "y", "z"};
inline constexpr std::array spacing_names = {"dx", "dy", "dz"};

}  // namespace seiche
