#include <seiche/problem/beta_fpu.hpp>
#include <seiche/problem/chain.hpp>
#include <seiche/problem/common/problem_rows.hpp>

namespace seiche {

Problem beta_fpu(const BetaFpu& options) {
  Problem p = chain({.points = options.points,
                     .boundary = options.boundary,
                     .neighbour_cubic = options.beta,
                     .neighbour_damping = options.internal_friction,
                     .gamma = options.gamma,
                     .initial = Chain::Initial::first_mode,
                     .amplitude = options.amplitude});
  p.name = "beta_fpu";
  p.fields = {"u", "v"};
  return p;
}

ProblemEntry beta_fpu_entry() {
  using P = BetaFpu;
  return ProblemRows<P>({.name = "beta_fpu",
                         .title = "β-FPUT lattice",
                         .equation =
                             "ü_j = d_j − d_{j−1} + β(d_j³ − d_{j−1}³) − γu̇_j + ν(ḋ_j − ḋ_{j−1}), d_j = u_{j+1} − u_j",
                         .reference = "Fermi, Pasta, Ulam, Tsingou, report LA-1940 (1955); Ford (1992)",
                         .fields = {"u", "v"},
                         .meanings = {"displacement", "velocity"},
                         .default_h = "1/8",
                         .default_end = 5000.0},
                        beta_fpu)
      .row(&P::points, {.name = "points",
                        .meaning = "N, masses on a ring or with free ends; N − 1 between fixed ends",
                        .minimum = 2,
                        .maximum = most_intervals})
      .row(chain_boundary_parameter("dirichlet"),
           [](P& p, const ParameterValues& v) { p.boundary = chain_boundary(v); })
      .row(&P::beta, {.name = "beta", .meaning = "β, cubic stiffness of the bonds"})
      .row(&P::internal_friction,
           {.name = "internal_friction", .meaning = "ν, friction between neighbours, 1/time", .minimum = 0})
      .row(&P::gamma, {.name = "gamma", .default_value = "1e-5", .meaning = "γ, damping rate, 1/time"})
      .row(&P::amplitude, {.name = "amplitude", .meaning = "of the first mode"})
      .preset("first_mode");
}

}  // namespace seiche
