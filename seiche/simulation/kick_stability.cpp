#include <seiche/backend/sparse/pade_poles.hpp>
#include <seiche/backend/sparse/sparse.hpp>
#include <seiche/backend/sparse/sparse_phi.hpp>
#include <seiche/method/splitting/nystrom_scheme.hpp>
#include <seiche/simulation/auto_method.hpp>
#include <seiche/simulation/kick_stability.hpp>

#include <fmt/format.h>

#include <cmath>

namespace seiche {

std::string beyond_stability(const Simulation& simulation, double h) {
  const MethodEntry& method = simulation.method();
  if (simulation.method_options().linear != LinearTreatment::explicit_kicks) return "";
  const double fastest = rates_of(simulation.system()).linear;
  const double largest = stability_of_kicks(nystrom_scheme(method.order)) / fastest;
  if (!(h > largest)) return "";
  return fmt::format(
      "h = {:.4g} is beyond the stability of {} with linear = \"explicit\": the linear part has rates up to {:.4g}, and kicks need h "
      "≤ {:.3g} there; take a smaller h, or linear = \"exact\"",
      h, method.name, fastest, largest);
}

std::string beyond_rate(const Simulation& simulation, double h, TimeSpan run) {
  constexpr int samples = 4096;
  const RatePointer& rate = simulation.problem().damping.rate;
  if (!simulation.method().kind.holds_rate_of_start || !rate || rate->is_constant()) return "";
  const double held = rate_of_D0(simulation.problem());
  double farthest = held;
  for (int i = 0; i <= samples; ++i) {
    const double gamma = rate->value(run.begin + run.length * i / samples);
    if (std::abs(gamma - held) > std::abs(farthest - held)) farthest = gamma;
  }
  if (!(h * std::abs(farthest - held) > 1)) return "";
  return fmt::format(
      "the rate {} reaches {:.3g}, and the exponential of {} holds the {:.3g} of the start: for what changes h ≤ {:.2g} is needed; or take "
      "a splitting such as seisav, which takes the integral of the rate, or a tolerance",
      rate->text(), farthest, simulation.method().name, held, 1 / std::abs(farthest - held));
}

// A force F against γ ≫ 1/h: the exact momentum is F/γ, and behind a splitting hF/2.
std::string beyond_splitting(const Simulation& simulation, double h) {
  const MethodEntry& method = simulation.method();
  if (!method.kind.splits_damping) return "";
  const System& system = simulation.system();
  Vector pushed(system.initial.size()), damped(pushed), damped_twice(pushed);
  system.right_hand_side(0, system.initial, pushed);
  system.damping->apply_D0(system.initial, damped);
  pushed += damped;
  system.damping->apply_D0(pushed, damped);
  system.damping->apply_D0(damped, damped_twice);
  const double length = system.space->norm(damped);
  const double rate = length > 0 ? system.space->norm(damped_twice) / length : 0;
  if (!(h * rate > 2)) return "";
  const bool of_order_four = method.order == 4;
  return fmt::format(
      "{} splits the damping from the forces, and {}: it is {:.3g} with h = {:.4g} and γ = {:.4g}; take h ≤ {:.2g}, or a method with the damping "
      "in its exponential (egc4, eisav)",
      method.name,
      of_order_four ? "is of order four only where hγ < 2"
                    : "where the two balance, momenta are wrong by the factor hγ/2",
      of_order_four ? h * rate : h * rate / 2, h, rate, 1 / rate);
}

std::string work_of_exponentials(const Simulation& simulation, const SparseOptions& options, double h,
                                 double duration) {
  constexpr double large = 1000;  // h times the fastest rate
  const MethodEntry& method = simulation.method();
  const bool by_krylov = method.projects() && simulation.method_options().linear == LinearTreatment::exact;
  const bool by_pade = !method.projects() && method.propagator == PropagatorKind::exponential &&
                       options.exponential == ExponentialKind::pade && options.pade_degree == 0;
  if (!simulation.backend().exponentials_by_krylov || !(by_krylov || by_pade)) return "";
  const double rate = sparse_rate(simulation.problem());
  if (!(h * rate > large)) return "";
  const double steps = std::ceil(duration / h);
  const std::string start = fmt::format(
      "h = {:.4g} is {:.3g} times as long as what the fastest rate {:.3g} resolves, and the sparse backend takes exponentials ",
      h, h * rate, rate);
  if (by_krylov) {
    const double substeps = krylov_substeps(h * rate);
    return start +
           fmt::format(
               "in about {:.2g} Krylov substeps each, {:.1g} or more in {:.3g} steps, about {:.1g} s; seisav with [backend] "
               "pade_degree = 6 takes the same time for every h and is exact for slow motion, and so does backend "
               "\"dense\" for up to some thousand unknowns",
               substeps, substeps * steps, steps,
               substeps * steps * (1e-5 + 1e-7 * static_cast<double>(simulation.problem().size())));
  }
  const PadePlan plan = plan_pade(h * rate, 1e-14);
  const double parts = static_cast<double>(plan.steps) * steps;
  constexpr double of_a_solve = 2e-7;  // seconds for an unknown and a degree, in two exponentials of a step
  return start +
         fmt::format(
             "in {} Padé parts of degree {} each, {:.1g} in {:.3g} steps, about {:.1g} s; [backend] pade_degree = 6 takes one "
             "part for every h, keeps the law and is exact for slow motion, and so does backend \"dense\" for up to some "
             "thousand unknowns",
             plan.steps, plan.degree, parts, steps,
             parts * plan.degree * of_a_solve * static_cast<double>(simulation.problem().size()));
}

std::vector<std::string> notes_on_step_size(const Simulation& simulation, const SparseOptions& options, double h,
                                            TimeSpan run) {
  std::vector<std::string> notes;
  for (const std::string& note :
       {beyond_stability(simulation, h), beyond_rate(simulation, h, run), beyond_splitting(simulation, h),
        work_of_exponentials(simulation, options, h, run.length)})
    if (!note.empty()) notes.push_back(note);
  return notes;
}

}  // namespace seiche
