#include "law_promise.hpp"

#include <fmt/format.h>
#include <seiche/core/law.hpp>
#include <seiche/study/certificate.hpp>

namespace seiche::cli {

LawPromise promise(const Simulation& simulation, const RunSpec& spec) {
  const std::string objection = spec.method_options.objection(simulation.method());
  if (!objection.empty()) return {false, objection};
  return promise_energy_law(simulation.problem(), spec.t_end);
}

std::string negative_rate(const Problem& problem) {
  const auto complaint = [](const auto& rate) -> std::string {
    if (!rate || rate->negative_seen() < 0) return "";
    return fmt::format("the rate {} is negative at t = {:.6g}", rate->text(), rate->negative_seen());
  };
  if (problem.friction)
    if (const std::string place = problem.friction->fed_at(); !place.empty())
      return fmt::format("the friction {} feeds energy at {}", problem.friction->text(), place);
  const std::string everywhere = complaint(problem.damping.rate);
  return everywhere.empty() ? complaint(problem.damping.field_rate) : everywhere;
}

}  // namespace seiche::cli
