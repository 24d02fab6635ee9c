#include <seiche/core/commuting_damping.hpp>
#include <seiche/core/simd/thread_count.hpp>
#include <seiche/law/law.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/simulation/end_of_potential.hpp>
#include <seiche/simulation/kick_stability.hpp>
#include <seiche/simulation/prepared_run.hpp>

#include <fmt/format.h>

#include <utility>

namespace seiche {
namespace {

SimulationOptions of_run(SimulationOptions options, const RunPlan& plan) {
  options.is_of_run = true;
  options.variable_steps = plan.tolerance.has_value();
  options.tolerance = plan.tolerance.value_or(0.0);
  options.duration = plan.t_end - plan.t_start;
  return options;
}

}  // namespace

PreparedRun::PreparedRun(const Problem& problem, const RunPlan& plan)
    : plan_(plan),
      varies_(!has_constant_rates(problem.damping) || problem.friction != nullptr),
      simulation_(std::make_shared<Simulation>(problem, of_run(plan.simulation, plan))),
      adaptive_(plan.tolerance ? &simulation_->adaptive_stepper() : nullptr) {
  if (!plan.tolerance)
    notes_ = notes_on_step_size(*simulation_, plan.simulation.backend_options.sparse, plan.h,
                                {plan.t_start, plan.t_end - plan.t_start});
  if (std::string note = note_on_threads(plan.simulation.backend_options.threads); !note.empty())
    notes_.push_back(std::move(note));
  certificate_ = certify(problem, {.method = std::string(simulation_->method().name),
                                   .method_options = simulation_->method_options(),
                                   .noise = plan.simulation.noise,
                                   .t_start = plan.t_start,
                                   .t_end = plan.t_end,
                                   .sample_solution = false,
                                   .at_start = simulation_.get(),
                                   .ranks = plan.simulation.backend_options.ranks});
  simulation_->state().t = plan.t_start;
  if (const Ranks* const ranks = plan.simulation.backend_options.ranks; ranks != nullptr) {
    const std::string objection = ranks->any(certificate_.law.promised ? "" : certificate_.law.reason);
    if (certificate_.law.promised && !objection.empty()) withdraw_law(objection);
  }
}

void PreparedRun::withdraw_law(const std::string& why) {
  certificate_.law.withdraw(why);
  certificate_.theorem.clear();
}

// Rates before t = 0 were not looked at.
LawPromise PreparedRun::promise() const {
  if (certificate_.law.promised && plan_.t_start < 0 && varies_)
    return {false, fmt::format("the damping changes in time, and the run starts at t = {:.6g} < 0", plan_.t_start)};
  return certificate_.law;
}

RunReport PreparedRun::integrate(Stepper& stepper, AdaptiveStepper* adaptive, const std::atomic<bool>& stop,
                                 std::span<Observer* const> observers, std::span<const Event> events,
                                 const Resumption& resumption) {
  const Ranks* const ranks = plan_.simulation.backend_options.ranks;
  const auto objection = [this, ranks] {
    const std::string met = negative_rate(simulation_->problem());
    return ranks != nullptr ? ranks->any(met) : met;
  };
  const auto explanation = [this] {
    const Problem& problem = simulation_->problem();
    return end_of_potential(problem, simulation_->system(), problem.initial, simulation_->state(),
                            plan_.tolerance ? 0 : plan_.h);
  };
  RunReport report = integrate_either(simulation_->system(), stepper, adaptive, simulation_->state(),
                                      {.tolerance = plan_.tolerance.value_or(0.0),
                                       .t_end = plan_.t_end,
                                       .first_h = plan_.h,
                                       .largest_h = plan_.h_max,
                                       .law = promise(),
                                       .objection = objection,
                                       .explanation = explanation,
                                       .stop = &stop,
                                       .events = events,
                                       .resumption = resumption},
                                      observers);
  if (const PointwiseStructure* structure = simulation_->problem().structure.get()) {
    const Vector values = simulation_->physical();
    const std::string found = structure->complaint_about({values.data(), static_cast<std::size_t>(values.size())});
    if (const std::string all = ranks != nullptr ? ranks->any(found) : found; !all.empty())
      report.say(fmt::format("at the end {}, and 0 stands for it", all));
  }
  return report;
}

Certificate PreparedRun::certificate_after(const RunReport& report) const {
  Certificate certificate = certificate_;
  if (!certificate.law.promised || report.law != LawVerdict::not_promised) return certificate;
  certificate.law = {.promised = false, .reason = report.law_reason};
  certificate.theorem.clear();
  return certificate;
}

}  // namespace seiche
