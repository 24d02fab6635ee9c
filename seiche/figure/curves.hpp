// Curves made ready for drawing: fewer points, markers spread out, envelopes instead of dips.
#pragma once

#include <seiche/study/results.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace seiche {

// At most about `points`: of each stretch its smallest and its largest value, so that no peak is lost.
Curve thinned(const Curve& curve, std::size_t points = 500);

// Indices of points for the markers of curve `index` of `count`.
std::vector<std::size_t> staggered(const std::vector<double>& t, int index, int count);

// True if the reference (the last curve if none has that name) stays positive and falls a hundredfold.
bool falls_by_decades(const std::vector<Curve>& energies);

// The largest value in each of `envelope_stretches` stretches, each where it is reached: for errors that change sign.
inline constexpr int envelope_stretches = 60;
Curve upper_envelope(const Curve& curve);

// "2⁻⁵", or "0.03".
std::string step_text(double h);

}  // namespace seiche
