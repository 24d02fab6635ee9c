// What the axes of a grid are called.
#pragma once

#include <array>

namespace seiche {

inline constexpr std::array axis_names = {"x", "y", "z"};

}  // namespace seiche
