#include <seiche/driver/headline.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace seiche {
namespace {

std::string fields_text(const std::vector<std::string>& fields) {
  constexpr std::size_t most_named = 6;
  return fields.size() > most_named ? fmt::format("{} fields", fields.size())
                                    : fmt::format("{}", fmt::join(fields, ", "));
}

const char* boundary_name(Boundary boundary) {
  switch (boundary) {
    case Boundary::dirichlet: return "dirichlet";
    case Boundary::neumann: return "neumann";
    case Boundary::periodic: break;
  }
  return "periodic";
}

// " on 64 × 32 points (periodic, dirichlet)", " at 20 points", or "" for a few degrees of freedom.
std::string points_text(const Grid& grid) {
  if (grid.only_numbers) return grid.unknowns() > 1 ? fmt::format(" at {} points", grid.unknowns()) : "";
  std::vector<std::string> counts, ends;
  for (const GridAxis& axis : grid.axes) {
    counts.push_back(fmt::format("{}", axis.unknowns()));
    ends.emplace_back(boundary_name(axis.boundary));
  }
  if (std::all_of(ends.begin(), ends.end(), [&](const std::string& end) { return end == ends.front(); }))
    ends.resize(1);
  return fmt::format(" on {} points ({})", fmt::join(counts, " × "), fmt::join(ends, ", "));
}

}  // namespace

std::string headline(const RunSpec& spec, const Simulation& simulation) {
  const Problem& problem = simulation.problem();
  const std::string steps =
      spec.tolerance ? fmt::format("tolerance {:.6g}", *spec.tolerance) : fmt::format("h = {:.9g}", spec.h);
  const std::string members = spec.ensemble ? fmt::format("{} members, each ", spec.ensemble->count()) : "";
  const std::string from = spec.t_start == 0 ? "" : fmt::format("from t = {:.9g} ", spec.t_start);
  return fmt::format("{}: {}{}{}, {} unknowns; {}, {}, backend {}, {}to t = {:.9g}", spec.problem, members,
                     fields_text(problem.fields), points_text(problem.grid.whole()),
                     problem.field_count() * problem.grid.whole().unknowns(), spec.method, steps,
                     simulation.backend().name, from, spec.t_end);
}

}  // namespace seiche
