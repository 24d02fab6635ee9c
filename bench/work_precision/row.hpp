// One measured run: a line of work_precision.csv.
#pragma once

#include <bench/peers/peer.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace seiche::bench {

enum class Status { solved, failed, skipped, refused };

struct Row {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::string problem, peer, library;
  Origin origin = Origin::packaged;
  Sweep sweep = Sweep::step_size;
  double parameter = 0;  // h or the tolerance, absolute and relative
  Status status = Status::solved;
  double cpu_seconds = unknown;  // median, of the time stepping alone
  int repeats = 0;               // that the median is of
  double setup_seconds = unknown;
  double error = unknown;         // max-norm at T
  double energy_error = unknown;  // |H − H_ref| at T
  Work work = {};
  std::int64_t energy_points = 0;  // at which H was read, in a run of its own
  std::int64_t energy_rises = 0;   // how often it rose beyond round-off from one to the next
  std::int64_t own_rises = -1;     // the same for an energy of the integrator's own; −1: it has none
  std::string message = {};
};

std::string_view to_string(Status status);
std::string_view to_string(Origin origin);
std::string_view to_string(Sweep sweep);

std::string csv_head();
std::string csv_line(const Row& row);

}  // namespace seiche::bench
