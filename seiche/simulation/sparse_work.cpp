#include <seiche/backend/sparse/pade_poles.hpp>
#include <seiche/backend/sparse/sparse.hpp>
#include <seiche/backend/sparse/sparse_phi.hpp>
#include <seiche/simulation/sparse_work.hpp>

#include <fmt/format.h>

#include <cmath>

namespace seiche {

std::string work_of_exponentials(const Simulation& simulation, const SparseOptions& options, double h, double t_end) {
  constexpr double large = 1000;  // h times the fastest rate
  const MethodEntry& method = simulation.method();
  const bool by_krylov = method.projects() && simulation.method_options().linear == LinearTreatment::exact;
  const bool by_pade = !method.projects() && method.propagator == PropagatorKind::exponential &&
                       options.exponential == ExponentialKind::pade && options.pade_degree == 0;
  if (!simulation.backend().exponentials_by_krylov || !(by_krylov || by_pade)) return "";
  const double rate = sparse_rate(simulation.problem());
  if (!(h * rate > large)) return "";
  const double steps = std::ceil(t_end / h);
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
  return start +
         fmt::format(
             "in {} Padé parts of degree {} each, {:.1g} in {:.3g} steps; [backend] pade_degree = 6 takes one part for every "
             "h, keeps the law and is exact for slow motion, and so does backend \"dense\" for up to some thousand unknowns",
             plan.steps, plan.degree, static_cast<double>(plan.steps) * steps, steps);
}

}  // namespace seiche
