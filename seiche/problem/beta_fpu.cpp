#include <seiche/problem/beta_fpu.hpp>
#include <seiche/problem/chain.hpp>
#include <seiche/problem/common/grid_options.hpp>

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
  return {
      .name = "beta_fpu",
      .equation = "ü_j = d_j − d_{j−1} + β(d_j³ − d_{j−1}³) − γu̇_j + ν(ḋ_j − ḋ_{j−1}), d_j = u_{j+1} − u_j",
      .reference = "Fermi, Pasta, Ulam, Tsingou, report LA-1940 (1955); Ford (1992)",
      .fields = {"u", "v"},
      .meanings = {"displacement", "velocity"},
      .parameters =
          {
              {.name = "points",
               .kind = ParameterKind::integer,
               .default_value = "32",
               .meaning = "N, bonds; N − 1 masses between fixed ends, N on a ring",
               .minimum = 2,
               .maximum = most_intervals},
              chain_boundary_parameter("dirichlet"),
              {.name = "beta", .default_value = "8.0", .meaning = "β, cubic stiffness of the bonds"},
              {.name = "internal_friction",
               .default_value = "0.0",
               .meaning = "ν, friction between neighbours, 1/time",
               .minimum = 0},
              {.name = "gamma",
               .kind = ParameterKind::rate,
               .default_value = "1e-5",
               .meaning = "γ, damping rate, 1/time"},
              {.name = "amplitude", .default_value = "1.0", .meaning = "of the first mode"},
          },
      .presets = {"first_mode"},
      .make =
          [](const ParameterValues& v, const std::string&) {
            return beta_fpu({.points = v.integer("points"),
                             .boundary = chain_boundary(v),
                             .beta = v.real("beta"),
                             .internal_friction = v.real("internal_friction"),
                             .gamma = v.damping_rate("gamma"),
                             .amplitude = v.real("amplitude")});
          },
      .default_h = "1/8",
      .default_end = 5000.0,
  };
}

}  // namespace seiche
