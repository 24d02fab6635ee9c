#include <seiche/core/base/vector.hpp>
#include <seiche/loop/settle_report.hpp>

#include <cmath>

namespace seiche {
namespace {

// Does round-off of the values, gathered over so many steps, change H as much as this drift? Where a state rests and
// terms of V cancel, all that is left of H is of this size.
bool is_round_off_of_state(const EnergyDrift& drift, const System& system, const Vector& values, std::int64_t steps) {
  const double in_all = 4 * epsilon * std::sqrt(static_cast<double>(steps) + 1);
  const Index points = values.size() / system.fields;
  Vector moved = values;
  for (Index f = 0; f < system.fields; ++f) {
    auto field = moved.segment(f * points, points);
    const double off = in_all * system.space->max_norm(values.segment(f * points, points));
    for (Index i = 0; i < points; ++i) field[i] += i % 2 == 0 ? off : -off;
  }
  Vector z(system.space->size()), z_moved(z.size());
  system.space->from_physical(values, z);
  system.space->from_physical(moved, z_moved);
  return std::abs(drift.to - drift.from) <= 10 * std::abs(system.energy(z_moved) - system.energy(z));
}

}  // namespace

void settle_report(RunReport& report, const System& system, FunctionRef<Vector()> values,
                   FunctionRef<std::string()> objection) {
  if (report.drift && is_round_off_of_state(*report.drift, system, values(), report.steps)) report.drift.reset();
  if (report.law == LawVerdict::not_promised && !report.drift) return;
  const std::string reason = objection();
  if (reason.empty()) return;
  report.drift.reset();  // H may well have risen
  if (report.law == LawVerdict::not_promised) return;
  report.law = LawVerdict::not_promised;
  report.law_reason = reason;
}

}  // namespace seiche
