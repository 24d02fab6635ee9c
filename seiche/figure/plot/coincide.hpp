// Curves that lie on top of each other in a picture: named in words, and drawn so that each is seen.
#pragma once

#include <seiche/figure/plot/plot.hpp>

#include <string>
#include <vector>

namespace seiche {

// Indices of series that lie within a line's width of each other, all with all, but for a tenth of their points at
// most; only groups of two or more.
std::vector<std::vector<std::size_t>> coinciding_series(const Plot& plot);

// "All or nearly all the way these coincide within the width of a line: SEAVF and SEILM.", or "".
std::string coincidence_sentence(const Plot& plot, const std::vector<std::vector<std::size_t>>& groups);

// Of each group the thin solid lines become dashes over the thick one; returns a sentence that says so, or "".
std::string separate(Plot& plot, const std::vector<std::vector<std::size_t>>& groups);

}  // namespace seiche
