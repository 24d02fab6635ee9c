#include <bench/work_precision/row.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace seiche::bench {
namespace {

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : ""; }
std::string count(std::int64_t value) { return value < 0 ? "" : fmt::format("{}", value); }

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c == '\n' ? ' ' : c;
  }
  return result + '"';
}

}  // namespace

std::string_view to_string(Status status) {
  constexpr std::array<std::string_view, 4> names = {"solved", "failed", "skipped", "refused"};
  return names[static_cast<std::size_t>(status)];
}

std::string_view to_string(Origin origin) {
  constexpr std::array<std::string_view, 3> names = {"seiche", "packaged", "hand-written"};
  return names[static_cast<std::size_t>(origin)];
}

std::string_view to_string(Sweep sweep) { return sweep == Sweep::step_size ? "h" : "tolerance"; }

std::string csv_head() {
  return "problem,method,library,origin,sweep,parameter,status,cpu_seconds,repeats,setup_seconds,error,energy_error,"
         "steps,evaluations,energy_points,energy_rises,own_energy_rises,message\n";
}

std::string csv_line(const Row& row) {
  return fmt::format("{},{},{},{},{},{:.10g},{},{},{},{},{},{},{},{},{},{},{},{}\n", row.problem, quoted(row.peer),
                     row.library, to_string(row.origin), to_string(row.sweep), row.parameter, to_string(row.status),
                     number(row.cpu_seconds), row.repeats, number(row.setup_seconds), number(row.error),
                     number(row.energy_error), count(row.work.steps), count(row.work.evaluations), row.energy_points,
                     row.energy_rises, count(row.own_rises), quoted(row.message));
}

}  // namespace seiche::bench
