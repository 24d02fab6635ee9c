#include <seiche/core/run_report.hpp>

#include <fmt/format.h>

#include <cmath>

namespace seiche {
namespace {

std::string energy_line(const char* name, const EnergySummary& energy) {
  return fmt::format("{:<10} {:.9g} → {:.9g}, largest increase between records {:.3g}\n", name, energy.initial,
                     energy.final, energy.max_increase);
}

}  // namespace

std::string counted_steps(std::int64_t count) { return fmt::format("{} step{}", count, count == 1 ? "" : "s"); }

std::string reached(double t, std::int64_t steps) {
  return fmt::format("reached t = {:.9g} in {}", t, counted_steps(steps));
}

std::string stopped(double t, std::int64_t n, double t_end) {
  return fmt::format("stopped at t = {:.9g} (step {}) of {:.9g}", t, n, t_end);
}

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
    case LawVerdict::not_tested: return "not tested";
  }
  return "unknown";
}

std::string RunReport::remark_on_replaced() const {
  const std::int64_t count = replaced.count;
  if (count == 0) return "";
  const std::string of_steps = count <= steps
                                   ? fmt::format("{} of {} steps", count, steps)  // the last may be taken back
                                   : counted_steps(count);
  const char* it = count == 1 ? "it" : "them";
  const std::string replacement =
      1e3 * static_cast<double>(count) < static_cast<double>(steps)
          ? fmt::format("{} {} replaced, because {}; what stands for {} keeps the energy law, but", of_steps,
                        count == 1 ? "was" : "were", replaced.why, it)
          : fmt::format("in {} no solution was found, because {}; what stands for {} keeps the energy law, and",
                        of_steps, replaced.why, it);
  const char* worth = replaced.lost_state ? "has lost most of the state"
                      : lacks_solution()  ? "has nothing to do with the equation any more"
                                          : "may be as inaccurate as any guess, and everything after it with it";
  return fmt::format("{} {}: take {}", replacement, worth, replaced.remedy);
}

void RunReport::judge_replaced() {
  const std::string remark = remark_on_replaced();
  if (remark.empty()) return;
  say(remark);
  if (lacks_solution()) status = Status::failed;
}

void add_to(std::string& message, const std::string& more) {
  if (message.find(more) == std::string::npos) message += "; " + more;
}

void RunReport::say_remarks(const std::string& lost_digits) {
  judge_replaced();
  if (!step_failed) say(lost_digits);
  say(remark_on_widened());
  say(remark_on_halved());
  if (!step_failed) say(remark_on_drift());
  if (!step_failed) say(remark_on_parting());
  if (unresolved > 0) say(fmt::format("{} scalar equations were not resolved", unresolved));
  if (law == LawVerdict::not_promised) say("no energy law is promised: " + law_reason);
  if (law == LawVerdict::violated && !step_failed) say("the promised energy law was violated: " + law_reason);
}

std::string RunReport::remark_on_widened() const {
  if (widened == 0) return "";
  return fmt::format(
      "in {} of {} h does not resolve a layer or an oscillation that the damping acts on, whose dissipation no quadrature "
      "sees; the interval for H was widened by what may be missed: take a smaller h",
      widened, counted_steps(steps));
}

std::string RunReport::remark_on_halved() const {
  if (halved == 0) return "";
  return fmt::format(
      "{} of {} {} taken in shorter parts, because the whole step found no solution: h does not resolve the nonlinear part, and "
      "errors may be large; take a smaller h",
      halved, counted_steps(steps), halved == 1 ? "was" : "were");
}

std::string EnergyDrift::text() const {
  if (is_parting) return fmt::format("H is {:.6g} where its modified energy is {:.6g}, at t = {:.6g}", to, from, t);
  return fmt::format("H itself {} from {:.6g} to {:.6g} at t = {:.6g}", to > from ? "rose" : "fell", from, to, t);
}

std::string RunReport::remark_on_drift() const {
  if (!drift) return "";
  if (drift->is_parting)
    return fmt::format(
        "the law is about the modified energy, and at t = {:.6g} that is {:.6g} where H is {:.6g}: the two have parted, and the "
        "solution is inaccurate; take smaller steps, or a method whose law is that of H (seilm, egc4)",
        drift->t, drift->from, drift->to);
  const char* equation =
      drift->is_damped ? "no solution of the equation lets it rise" : "nothing in the equation changes it";
  if (has_modified_energy && law == LawVerdict::holds)
    return fmt::format(
        "the law holds for the modified energy, and {}, although {}: the two have parted, and the solution is inaccurate; take "
        "smaller steps, or a method whose law is that of H (seilm, egc4)",
        drift->text(), equation);
  return fmt::format(
      "{}, although {}: the solution is inaccurate; take smaller steps, or a method whose law is that of H (seilm, egc4)",
      drift->text(), equation);
}

std::vector<std::string> RunReport::remarks() const {
  std::vector<std::string> all = {remark_on_replaced(), remark_on_halved(), remark_on_drift()};
  std::erase(all, "");
  return all;
}

std::string RunReport::remark_on_parting() const {
  if (!has_modified_energy || drift) return "";
  const double apart = energy.final - modified.final;
  const double share = std::abs(apart) / std::abs(energy.initial);
  if (!(share > 1e-3)) return "";
  return fmt::format("at the end H is {:.3g} {} the modified energy that the law is about, {:.2g} % of where H began",
                     std::abs(apart), apart > 0 ? "above" : "below", 100 * share);
}

std::string RunReport::brief() const {
  return fmt::format("{}: t = {:.9g} after {} in {:.3g} s; H {:.6g} → {:.6g}, law {}", to_string(status), t,
                     counted_steps(steps), wall_seconds, energy.initial, energy.final, to_string(law));
}

std::string RunReport::full() const {
  std::string text = fmt::format("{}: {}\n", to_string(status), message);
  text += fmt::format("{:<10} {:.9g} after {} in {:.3g} s\n", "t", t, counted_steps(steps), wall_seconds);
  text += energy_line("H", energy);
  if (has_modified_energy) text += energy_line("H modified", modified);
  const char* of = has_modified_energy ? "H modified" : "H";
  const bool stopped = status == Status::failed && law != LawVerdict::not_tested;
  const std::string until = stopped ? fmt::format(" up to t = {:.9g}", t) : "";
  const std::string why = law == LawVerdict::not_promised ? "" : fmt::format(" ({})", law_reason);  // else in `message`
  return text + fmt::format("{:<10} {} for {}{}{}\n", "energy law", to_string(law), of, until, why);
}

std::string RunReport::work() const {
  std::string text = fmt::format(
      "{:<10} {} gradients, {} potentials, {} scalar iterations, fallbacks: {}, replaced steps: {}, unresolved: {}\n",
      "work", potential_counts.gradients, potential_counts.values, scalar_iterations, fallbacks, replaced.count,
      unresolved);
  if (!solver) return text;
  text += fmt::format("{:<10} {} iterations", "solver", solver->iterations);
  if (solver->restored > 0)
    text += fmt::format("; what it missed of the law restored by {:.2g} at most", solver->restored);
  return text + "\n";
}

}  // namespace seiche
