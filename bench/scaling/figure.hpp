// Nanoseconds per grid point and step against N, and what N log N would be.
#pragma once

#include <bench/scaling/sizes.hpp>

#include <filesystem>
#include <vector>

namespace seiche::bench {

// Leaves scaling.png and scaling.pdf. Throws Error where Python or Matplotlib is missing or fails.
void draw_scaling(const std::vector<SizeCost>& costs, Index smallest, const std::filesystem::path& directory);

}  // namespace seiche::bench
