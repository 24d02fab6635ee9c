#include <seiche/core/base/error.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/common/problem_rows.hpp>
#include <seiche/problem/gradient_flow/one_field.hpp>
#include <seiche/problem/gradient_flow/phase_separation.hpp>
#include <seiche/problem/gradient_flow/varying_mobility.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

// ρ(u − a)²(u − b)² = ρ(u² − su + p)², s = a + b, p = ab; less what stands in M.
std::vector<double> double_well(const PhaseSeparation& options) {
  const double s = options.low + options.high, p = options.low * options.high, rho = options.barrier;
  return {rho * p * p, -2 * rho * s * p, rho * (s * s + 2 * p) - options.stabilisation / 2, -2 * rho * s, rho};
}

// u = (a + b)/2 + (b − a)/2 tanh((R − r)/w), which a flat interface has at rest: w = √(2κ/ρ)/|b − a|.
Vector drop(const PhaseSeparation& options, const Grid& grid) {
  const double span = options.high - options.low;
  const double width = std::sqrt(2 * options.kappa / options.barrier) / std::abs(span);
  return around_centre(grid, [&](double distance) {
    const double inside = grid.axis(0).length / 4 - distance;
    return (options.low + options.high) / 2 + span / 2 * std::tanh(inside / width);
  });
}

Problem phase_separation(const char* name, const PhaseSeparation& options, bool conserves_mean) {
  for (const auto& [what, value] : {std::pair("kappa", options.kappa), std::pair("barrier", options.barrier)})
    if (!(value > 0)) throw Error("{} = {} must be > 0", what, value);
  if (!(options.stabilisation >= 0)) throw Error("stabilisation = {} must be ≥ 0", options.stabilisation);
  if (options.low == options.high) throw Error("low = {} and high = {} must differ", options.low, options.high);
  const StateFunctionPointer& M = options.mobility_of_u;
  const double m = M ? middle_mobility(*M, std::min(options.low, options.high), std::max(options.low, options.high))
                     : options.mobility;
  Problem p = flow_of_one_field(name, options.grid, {m, conserves_mean});
  if (M) add_varying_mobility(p, M, m, conserves_mean, options.grid);
  p.M(0, 0) = Stencil::identity(options.stabilisation) +
              -options.kappa * Stencil::laplacian(p.grid, options.grid.discretisation);
  p.potential = on_grid(nodal_polynomial(double_well(options)), p.grid, options.grid);
  constexpr double far = 10;  // beside their distance: V is a difference of terms as much larger
  if (std::abs(options.low + options.high) > far * std::abs(options.high - options.low))
    p.notes.push_back(
        fmt::format("low = {} and high = {} lie far from 0, and V loses digits: shift u", options.low, options.high));
  p.initial = options.initial == PhaseSeparation::Initial::drop ? drop(options, p.grid)
                                                                : low_waves(p.grid, options.mean, options.amplitude);
  return p;
}

ProblemEntry with_rows(ProblemEntry about, Problem (*make)(const PhaseSeparation&)) {
  using P = PhaseSeparation;
  about.fields = {"u"};
  about.meanings = {"order parameter"};
  return ProblemRows<P>(std::move(about), make)
      .grid(&P::grid)
      .row(&P::kappa,
           {.name = "kappa", .meaning = "κ, gradient energy ½κ|∇u|²", .minimum = 0, .minimum_excluded = true})
      .row({.name = "mobility",
            .kind = ParameterKind::function,
            .default_value = "1.0",
            .meaning = "m, mobility; or M(u), a formula in u, for egc2 … egc8, seimp and etdrk4",
            .minimum = 0,
            .minimum_excluded = true},
           [](P& p, const ParameterValues& v) {
             p.mobility_of_u = v.function("mobility");
             if (!p.mobility_of_u) p.mobility = v.real("mobility");
           })
      .row(&P::barrier, {.name = "barrier",
                         .meaning = "ρ, of the double well ρ(u − a)²(u − b)²",
                         .minimum = 0,
                         .minimum_excluded = true})
      .row(&P::low, {.name = "low", .meaning = "a, one phase"})
      .row(&P::high, {.name = "high", .meaning = "b, the other phase"})
      .row(&P::stabilisation,
           {.name = "stabilisation",
            .meaning = "β, of ½βu² that stands in M and not in V: H is the same, and steps may be longer",
            .minimum = 0})
      .row(&P::mean, {.name = "mean", .meaning = "of the initial waves"})
      .row(&P::amplitude, {.name = "amplitude", .meaning = "A, of the initial waves"})
      .presets(&P::initial, {"waves", "drop"});
}

}  // namespace

Problem allen_cahn(const PhaseSeparation& options) { return phase_separation("allen_cahn", options, false); }
Problem cahn_hilliard(const PhaseSeparation& options) { return phase_separation("cahn_hilliard", options, true); }

ProblemEntry allen_cahn_entry() {
  return with_rows({.name = "allen_cahn",
                    .title = "Allen–Cahn equation",
                    .equation = "u_t = m(κΔu − W′(u)), W = ρ(u − a)²(u − b)²",
                    .reference = "Allen, Cahn (1979)",
                    .fields = {},
                    .default_h = "1/16",
                    .default_end = 20.0},
                   allen_cahn);
}

ProblemEntry cahn_hilliard_entry() {
  return with_rows({.name = "cahn_hilliard",
                    .title = "Cahn–Hilliard equation",
                    .equation = "u_t = mΔ(W′(u) − κΔu), W = ρ(u − a)²(u − b)²",
                    .reference = "Cahn, Hilliard (1958)",
                    .fields = {},
                    .default_h = "1/8192",
                    .default_end = 0.1},
                   cahn_hilliard);
}

}  // namespace seiche
