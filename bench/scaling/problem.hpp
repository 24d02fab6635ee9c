// The problem whose size grows: defocusing Klein–Gordon on a ring at the paper's Δx = 0.1.
#pragma once

#include <seiche/damping/rates.hpp>
#include <seiche/problem/klein_gordon.hpp>

namespace seiche::bench {

inline Problem line_problem(Index points) {
  return klein_gordon({.grid = {.points = {points}, .length = {0.1 * static_cast<double>(points)}},
                       .alpha = 1.0,
                       .gamma = constant_rate(0.1)});
}

}  // namespace seiche::bench
