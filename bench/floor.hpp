// A step of seisav beside the transforms it cannot do without and a triad, timed in turns in one process.
#pragma once

#include <seiche/core/problem.hpp>

namespace seiche::bench {

struct Floor {
  double step = 0, by_gradient = 0, transforms = 0, fftw = 0, triad = 0;  // median seconds
};

struct FloorOptions {
  bool measure_plans = true;
  int threads = 1;
  int rounds = 7;
  double seconds_per_round = 0.02;  // of each contestant
};

// step: one of seisav on the modal backend, which takes two transforms. by_gradient: the same with the paper's
// predictor, which takes four. transforms: four, by the backend's own code. fftw: the same four by one plan of FFTW for
// the whole grid (periodic grids; else 0). triad: a = b + s c over the unknowns of one field.
Floor measure_floor(const Problem& problem, const FloorOptions& options);

}  // namespace seiche::bench
