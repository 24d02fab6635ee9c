// Draws curves through states too far apart as dots, so that corners of the picture are not taken for the solution's.
#pragma once

#include <seiche/figure/plot/plot.hpp>

#include <string>
#include <vector>

namespace seiche {

// Where the lines between states turn by 15° at a state, the states become dots on a thin line; where they turn by 60°,
// as in a section once a period, there is no line. `states` are those of the file, of which the curves may show fewer.
// Returns a sentence that says so, or "".
std::string show_corners(std::vector<Series>& curves, const Axis& x, const Axis& y, std::size_t states);

}  // namespace seiche
