// Seconds to reach an error: the one number per integrator and accuracy.
#pragma once

#include <bench/work_precision/sweep.hpp>

#include <array>
#include <string>
#include <vector>

namespace seiche::bench {

inline constexpr std::array<double, 3> wanted_errors = {1e-3, 1e-6, 1e-9};

// One integrator on one problem.
struct Curve {
  std::string peer;
  Origin origin = Origin::packaged;
  std::string library;
  std::vector<const Row*> rows;  // from coarse to fine, unsolved ones among them
};

std::vector<Curve> curves_of(const ProblemResult& result);  // in the order in which they were measured

// The least time with which the curve reaches `error`, interpolated in log–log between neighbouring runs; NaN if it
// never does.
double seconds_to_reach(const Curve& curve, double error);

// How the integrator treats the energy law that it promises, or H: "kept" only if no solved run saw a rise.
struct EnergyLaw {
  int runs = 0;  // solved
  int runs_with_rise = 0;
  int runs_where_H_rose = 0;  // whatever energy judges
  std::int64_t most_rises = 0;
  bool own = false;  // judged by an energy of the integrator's own
};
EnergyLaw energy_law(const Curve& curve);

}  // namespace seiche::bench
