#include <seiche/core/run_report.hpp>

#include <fmt/format.h>

namespace seiche {
namespace {

std::string energy_line(const char* name, const EnergySummary& energy) {
  return fmt::format("{:<10} {:.9g} → {:.9g}, largest increase between records {:.3g}\n", name, energy.initial,
                     energy.final, energy.max_increase);
}

}  // namespace

std::string to_string(RunReport::Status status) {
  switch (status) {
    case RunReport::Status::success: return "success";
    case RunReport::Status::failed: return "failed";
    case RunReport::Status::interrupted: return "interrupted";
  }
  return "unknown";
}

std::string to_string(LawVerdict verdict) {
  switch (verdict) {
    case LawVerdict::holds: return "holds";
    case LawVerdict::violated: return "violated";
    case LawVerdict::not_promised: return "not promised";
  }
  return "unknown";
}

std::string RunReport::brief() const {
  return fmt::format("{}: t = {:.9g} after {} steps in {:.3g} s; H {:.6g} → {:.6g}, law {}", to_string(status), t,
                     steps, wall_seconds, energy.initial, energy.final, to_string(law));
}

std::string RunReport::full() const {
  std::string text = fmt::format("{}: {}\n", to_string(status), message);
  text += fmt::format("{:<10} {:.9g} after {} steps in {:.3g} s\n", "t", t, steps, wall_seconds);
  text += energy_line("H", energy);
  if (has_modified_energy) text += energy_line("H modified", modified);
  const char* of = has_modified_energy ? "H modified" : "H";
  const std::string until = status == Status::failed ? fmt::format(" up to t = {:.9g}", t) : "";
  const std::string why = law == LawVerdict::not_promised ? "" : fmt::format(" ({})", law_reason);  // else in `message`
  text += fmt::format("{:<10} {} for {}{}{}\n", "energy law", to_string(law), of, until, why);
  text +=
      fmt::format("{:<10} {} gradients, {} potentials, {} scalar iterations, fallbacks: {}, unresolved: {}\n", "work",
                  potential_counts.gradients, potential_counts.values, scalar_iterations, fallbacks, unresolved);
  return text;
}

}  // namespace seiche
