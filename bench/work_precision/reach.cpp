#include <bench/work_precision/reach.hpp>

#include <algorithm>
#include <cmath>

namespace seiche::bench {

std::vector<Curve> curves_of(const ProblemResult& result) {
  std::vector<Curve> curves;
  for (const Row& row : result.rows) {
    auto found = std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return c.peer == row.peer; });
    if (found == curves.end()) {
      curves.push_back({.peer = row.peer, .origin = row.origin, .library = row.library, .rows = {}});
      found = std::prev(curves.end());
    }
    found->rows.push_back(&row);
  }
  // A refused integrator comes first among the rows; here Seiche does.
  std::stable_sort(curves.begin(), curves.end(), [](const Curve& a, const Curve& b) { return a.origin < b.origin; });
  return curves;
}

double seconds_to_reach(const Curve& curve, double error) {
  double least = INFINITY;
  const Row* before = nullptr;
  for (const Row* row : curve.rows) {
    if (row->status != Status::solved) {
      before = nullptr;  // nothing is known between a failed run and the next
      continue;
    }
    if (row->error <= error) {
      double seconds = row->cpu_seconds;
      if (before && before->error > error) {
        // An error of exactly zero has no logarithm; 1e-16 is as good as it.
        const double finer = std::log(std::max(row->error, 1e-16));
        const double weight = (std::log(error) - std::log(before->error)) / (finer - std::log(before->error));
        seconds =
            std::exp(std::log(before->cpu_seconds) + weight * (std::log(seconds) - std::log(before->cpu_seconds)));
      }
      least = std::min(least, seconds);
    }
    before = row;
  }
  return std::isfinite(least) ? least : Row::unknown;
}

EnergyLaw energy_law(const Curve& curve) {
  EnergyLaw law;
  for (const Row* row : curve.rows) {
    if (row->status != Status::solved) continue;
    ++law.runs;
    law.own = row->own_rises >= 0;
    const std::int64_t rises = law.own ? row->own_rises : row->energy_rises;
    if (rises > 0) ++law.runs_with_rise;
    if (row->energy_rises > 0) ++law.runs_where_H_rose;
    law.most_rises = std::max(law.most_rises, rises);
  }
  return law;
}

}  // namespace seiche::bench
