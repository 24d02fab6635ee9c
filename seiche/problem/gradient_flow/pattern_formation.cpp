#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/common/problem_rows.hpp>
#include <seiche/problem/gradient_flow/one_field.hpp>
#include <seiche/problem/gradient_flow/pattern_formation.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seiche {
namespace {

Problem pattern_formation(const char* name, const PatternFormation& options, bool conserves_mean) {
  Problem p = flow_of_one_field(name, options.grid, {options.mobility, conserves_mean});
  const Stencil root = Stencil::identity(square(options.q)) + Stencil::laplacian(p.grid, options.grid.discretisation);
  p.M(0, 0) = Stencil::product(root, root);
  p.potential = on_grid(nodal_polynomial({0, 0, -options.r / 2, -options.g / 3, 0.25}), p.grid, options.grid);
  const double radius = std::numbers::pi / std::max(std::abs(options.q), 1e-3);
  const auto seed = [&](double distance) {
    return options.mean + options.amplitude * std::exp(-square(distance / radius) / 2);
  };
  p.initial = options.initial == PatternFormation::Initial::seed ? around_centre(p.grid, seed)
                                                                 : low_waves(p.grid, options.mean, options.amplitude);
  return p;
}

ProblemEntry with_rows(ProblemEntry about, Problem (*make)(const PatternFormation&), double r, double mean) {
  using P = PatternFormation;
  about.fields = {"u"};
  about.meanings = {"order parameter"};
  return ProblemRows<P>(std::move(about), make)
      .grid(&P::grid)
      .row(&P::r, {.name = "r", .default_value = toml_real(r), .meaning = "r, drives the pattern where it is positive"})
      .row(&P::g, {.name = "g", .meaning = "g, of the cubic term of H"})
      .row(&P::q, {.name = "q", .meaning = "q, wave number of the pattern"})
      .row(&P::mobility, {.name = "mobility", .meaning = "m, mobility", .minimum = 0, .minimum_excluded = true})
      .row(&P::mean, {.name = "mean", .default_value = toml_real(mean), .meaning = "of the initial data"})
      .row(&P::amplitude, {.name = "amplitude", .meaning = "A, of the initial data"})
      .presets(&P::initial, {"waves", "seed"});
}

}  // namespace

Problem swift_hohenberg(const PatternFormation& options) {
  return pattern_formation("swift_hohenberg", options, false);
}
Problem phase_field_crystal(const PatternFormation& options) {
  return pattern_formation("phase_field_crystal", options, true);
}

ProblemEntry swift_hohenberg_entry() {
  return with_rows({.name = "swift_hohenberg",
                    .title = "Swift–Hohenberg equation",
                    .equation = "u_t = m(ru − (q² + Δ)²u + gu² − u³)",
                    .reference = "Swift, Hohenberg (1977)",
                    .fields = {},
                    .default_h = "1/16",
                    .default_end = 100.0},
                   swift_hohenberg, 0.3, 0.0);
}

ProblemEntry phase_field_crystal_entry() {
  return with_rows({.name = "phase_field_crystal",
                    .title = "Phase-field crystal",
                    .equation = "u_t = mΔ((q² + Δ)²u − ru − gu² + u³)",
                    .reference = "Elder, Katakowski, Haataja, Grant (2002)",
                    .fields = {},
                    .default_h = "1/8",
                    .default_end = 400.0},
                   phase_field_crystal, 0.25, -0.25);
}

}  // namespace seiche
