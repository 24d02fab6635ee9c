// What the axes of a grid are called, and the distances of its points along them.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string>

namespace seiche {

inline constexpr std::array axis_names = {"x", "y", "z"};
inline constexpr std::array spacing_names = {"dx", "dy", "dz"};

inline std::string counted_axes(std::size_t axes) { return fmt::format("{} ax{}", axes, axes == 1 ? "is" : "es"); }

}  // namespace seiche
