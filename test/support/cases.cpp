#include <test/support/cases.hpp>

#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/config/data/rate_formulas.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/damping/formula_frictions.hpp>
#include <seiche/damping/frictions.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/problem/alpha_fpu.hpp>
#include <seiche/problem/beta_fpu.hpp>
#include <seiche/problem/burgers.hpp>
#include <seiche/problem/chain.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/gradient_flow/pattern_formation.hpp>
#include <seiche/problem/gradient_flow/phase_separation.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/network.hpp>
#include <seiche/problem/nls.hpp>
#include <seiche/problem/oscillator.hpp>
#include <seiche/problem/rigid_body.hpp>
#include <seiche/problem/sine_gordon.hpp>
#include <seiche/problem/sparse.hpp>
#include <seiche/problem/truss.hpp>
#include <seiche/problem/variable_wave.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seiche::test {

Problem klein_gordon_case(double gamma, double alpha) {
  return klein_gordon({.alpha = alpha, .gamma = constant_rate(gamma)});
}

Problem fpu_conservative_case(double gamma, double beta) {
  return alpha_fpu({.beta = beta, .gamma = constant_rate(gamma)});
}

Problem fpu_dissipative_case(double gamma, double beta) {
  return alpha_fpu({.beta = beta, .gamma = constant_rate(gamma), .formulation = AlphaFpu::Formulation::dissipative});
}

Problem gkdv_case(double mu, double sigma, double amplitude) {
  Problem p = gkdv({.sigma = sigma, .mu = constant_rate(mu)});
  p.initial *= amplitude / 0.4;
  return p;
}

Problem duffing_case(double gamma) { return oscillator({.gamma = constant_rate(gamma)}); }

std::vector<NamedProblem> golden_cases() {
  return {{"paper_KG", klein_gordon_case()},
          {"paper_FPU_2.1", fpu_conservative_case()},
          {"paper_FPU_2.2", fpu_dissipative_case()},
          {"paper_gKdV", gkdv_case()}};
}

std::vector<NamedProblem> grid_cases() {
  using enum Boundary;
  const auto wave = [](GridOptions grid) {
    const std::size_t axes = std::max(grid.points.size(), grid.boundary.size());
    Problem p = klein_gordon({.grid = std::move(grid), .alpha = 1.0, .gamma = constant_rate(0.2)});
    for (Index i = 0; i < p.size(); ++i) p.initial[i] = std::sin(1.3 * static_cast<double>(i + 1));
    p.name = fmt::format("{}_{}d", p.name, axes);
    return p;
  };
  std::vector<NamedProblem> cases = {
      {"KG_neumann", wave({.points = {12}, .length = {2.0}, .boundary = {neumann}})},
      {"KG_dirichlet_fd4",
       wave({.points = {12}, .length = {2.0}, .boundary = {dirichlet}, .discretisation = Discretisation::fd4})},
      {"KG_2d_periodic", wave({.points = {6, 5}, .length = {1.0, 2.0}})},
      {"KG_2d_even_spectral",
       wave({.points = {4, 6}, .length = {1.0, 2.0}, .discretisation = Discretisation::spectral})},
      {"KG_2d_mixed", wave({.points = {6, 5}, .length = {1.0, 2.0}, .boundary = {periodic, dirichlet}})},
      {"KG_3d_periodic", wave({.points = {3, 4, 2}, .length = {1.0}})},
      {"KG_3d_mixed_spectral", wave({.points = {3, 4, 4},
                                     .length = {1.0},
                                     .boundary = {neumann, periodic, dirichlet},
                                     .discretisation = Discretisation::spectral})},
  };
  for (const Discretisation d : {Discretisation::fd4, Discretisation::spectral}) {
    cases.push_back({d == Discretisation::fd4 ? "gKdV_fd4" : "gKdV_spectral",
                     gkdv({.points = 10, .discretisation = d, .sigma = -0.5, .mu = constant_rate(0.3)})});
  }
  cases.push_back(
      {"sine_Gordon", sine_gordon({.grid = {.points = {24}, .length = {12.0}}, .gamma = constant_rate(0.1)})});
  cases.push_back({"gKdV_dealiased", gkdv({.points = 10,
                                           .discretisation = Discretisation::spectral,
                                           .two_thirds = true,
                                           .sigma = -0.5,
                                           .mu = constant_rate(0.3)})});
  cases.push_back(
      {"KG_2d_dealiased",
       wave({.points = {6, 5}, .length = {1.0}, .discretisation = Discretisation::spectral, .two_thirds = true})});
  cases.push_back(
      {"NLS_focusing", nls({.grid = {.points = {10}, .length = {6.0}, .discretisation = Discretisation::spectral},
                            .gamma = constant_rate(0.2)})});
  cases.push_back({"NLS_2d_mixed", nls({.grid = {.points = {4, 4}, .length = {4.0}, .boundary = {neumann, dirichlet}},
                                        .kappa = -1.0,
                                        .gamma = constant_rate(0.2),
                                        .initial = Nls::Initial::gaussian})});
  return cases;
}

std::vector<NamedProblem> chain_cases() {
  return {{"chain_fixed", chain({.points = 8,
                                 .neighbour_cubic = 0.5,
                                 .ground_spring = 0.3,
                                 .ground_cubic = -0.2,
                                 .neighbour_damping = 0.1,
                                 .gamma = constant_rate(0.05)})},
          {"chain_ring", chain({.points = 7,
                                .boundary = Boundary::periodic,
                                .mass = 2.0,
                                .neighbour_cubic = 0.5,
                                .ground_spring = 0.3,
                                .ground_cubic = 0.2,
                                .neighbour_damping = 0.1,
                                .gamma = constant_rate(0.05),
                                .initial = Chain::Initial::first_mode})},
          {"chain_free", chain({.points = 7,
                                .boundary = Boundary::neumann,
                                .neighbour_cubic = 0.5,
                                .ground_spring = 0.1,
                                .neighbour_damping = 0.1,
                                .gamma = constant_rate(0.05)})},
          {"FPUT_beta", beta_fpu({.points = 10, .internal_friction = 0.02, .gamma = constant_rate(0.1)})}};
}

std::vector<NamedProblem> field_rate_cases() {
  const SpaceRatePointer steady = formula_space_rate(compile_formula("0.1 + exp(-(x - 1)^2)", {"t", "x"}), 1, true);
  const SpaceRatePointer varying =
      formula_space_rate(compile_formula("(0.3 + 0.2*sin(3*t))*(1 + cos(2*x)*sin(y)/2)", {"t", "x", "y"}), 2, false);
  const GridOptions square{.points = {4, 3}, .length = {2.0, 1.0}, .boundary = {Boundary::neumann, Boundary::periodic}};
  return {{"KG_field_rate", klein_gordon({.grid = {.points = {10}, .length = {2.0}}, .alpha = 1.0, .gamma = steady})},
          {"KG_field_rate_2d", klein_gordon({.grid = square, .alpha = 1.0, .gamma = varying})},
          // where γ(x) and the rest of D do not commute, and where it moves what V depends on
          {"chain_field_rate", chain({.points = 6, .neighbour_cubic = 0.5, .neighbour_damping = 0.3, .gamma = steady})},
          {"NLS_field_rate", nls({.grid = {.points = {10}, .length = {6.0}}, .gamma = steady})}};
}

std::vector<NamedProblem> matrix_cases() {
  const auto speed = [](const std::array<double, 3>& x) { return x[0] > 3.0 ? 2.0 : 1.0; };
  std::vector<NamedProblem> cases = {
      {"wave_layers", variable_wave({.grid = {.points = {10}, .length = {6.0}, .boundary = {Boundary::dirichlet}},
                                     .speed = speed,
                                     .mass = 0.5,
                                     .alpha = 1.0,
                                     .gamma = constant_rate(0.1)})},
      {"wave_2d",
       variable_wave(
           {.grid = {.points = {4, 3}, .length = {6.0, 3.0}, .boundary = {Boundary::neumann, Boundary::periodic}},
            .speed = speed,
            .faces = VariableWave::Faces::arithmetic,
            .alpha = 1.0,
            .gamma = constant_rate(0.1)})},
      {"truss", truss({.panels = 3, .mass = 2.0, .stiffness = 20, .quartic = 30, .gamma = constant_rate(0.05)})},
      {"network", network({.adjacency = small_world(9, 1, 3, 1), .gamma = constant_rate(0.1)})}};
  for (NamedProblem& c : cases)
    for (Index i = 0; i < c.problem.size(); ++i)
      c.problem.initial[i] += 0.3 * std::sin(1.3 * static_cast<double>(i + 1));
  return cases;
}

// Where the constant D couples the field that γ(t) damps with the one that it does not, so that the two do not commute.
Problem coupled_damping_case(RatePointer gamma) {
  constexpr Index n = 3;
  SparseMatrix M(2 * n, 2 * n);
  SparseMatrix D(2 * n, 2 * n);
  M.setIdentity();
  for (Index i = 0; i < n; ++i) {
    M.coeffRef(i, i) = 1 + 0.3 * static_cast<double>(i);
    D.insert(i, i) = D.insert(n + i, n + i) = 0.5;
    D.insert(i, n + i) = 0.9;
    D.insert(n + i, i) = -0.9;
  }
  return sparse_problem({.matrices = {.S = {}, .M = M, .D = D}, .quartic = 1.0, .gamma = std::move(gamma)});
}

std::vector<NamedProblem> beyond_linear_cases() {
  const auto with = [](Problem p, FrictionPointer friction) {
    p.friction = std::move(friction);
    return p;
  };
  const auto formula = [](const char* text) {
    return FrictionFormula{.formula = compile_formula(text, {"v", "u", "t", "x", "y", "z"})};
  };
  const auto forced = [](Problem p, std::size_t field, const char* text) {
    p.forces.assign(static_cast<std::size_t>(p.field_count()), nullptr);
    p.forces[field] = formula_space_rate(compile_formula(text, {"t", "x"}), 1, false)->on(p.grid);
    return p;
  };
  const Problem wave = klein_gordon_case(0.1, 1.0);
  const Problem undamped = klein_gordon_case(0, 1.0);
  const Problem heavy = chain({.points = 7, .mass = 2.5});
  return {
      {"KG_drag", with(wave, quadratic_friction(0, 0.5))},
      {"KG_cubic_friction", with(undamped, cubic_friction(2.0))},
      {"KG_saturating_friction", with(undamped, saturating_friction(0.1, 0.2))},
      {"chain_drag", with(heavy, quadratic_friction(0.1, 0.3))},
      {"truss_isotropic_drag", with(truss({.panels = 4}), isotropic_friction(2.0, 2))},
      {"KG_friction_by_position",
       with(undamped, position_friction(formula("0.3*u^2 + 0.1*(1 + sin(3*x))"), undamped.grid))},
      {"Duffing_formula_friction",
       with(duffing_case(), formula_friction(formula("0.2*sinh(v) + 0.1*u^2*v"), duffing_case().grid))},
      {"van_der_Pol", with(duffing_case(0), position_friction(formula("u^2 - 1"), duffing_case().grid))},
      {"KG_forced", forced(wave, 1, "0.2*cos(2*t)*sin(3*x)")},
      {"gKdV_forced", forced(gkdv_case(0.5, -0.5), 0, "0.1*sin(3*t)*cos(x)")},
      {"Burgers", burgers({.points = 16, .nu = 0.02, .gamma = constant_rate(0.1)})},
      {"KdV_quadratic_fd4",
       burgers(
           {.length = 12, .points = 24, .discretisation = Discretisation::fd4, .alpha = 2.0, .epsilon = 0.5, .nu = 0})},
      {"rigid_body", rigid_body({.gamma = constant_rate(0.1)})},
      {"Cahn_Hilliard_mobility_fd2",
       cahn_hilliard({.grid = {.points = {5, 4}, .length = {4.0}, .boundary = {Boundary::neumann, Boundary::periodic}},
                      .kappa = 0.5,
                      .mobility_of_u = compile_state_function("0.1 + 0.05*u", "u"),
                      .mean = 0.2})},
      {"Cahn_Hilliard_mobility_spectral",
       cahn_hilliard({.grid = {.points = {12}, .length = {6.0}, .discretisation = Discretisation::spectral},
                      .kappa = 0.5,
                      .mobility_of_u = compile_state_function("0.005*(1 - u^2/4)", "u")})},
      {"Allen_Cahn_mobility",
       allen_cahn(
           {.grid = {.points = {12}}, .kappa = 0.01, .mobility_of_u = compile_state_function("0.25 + 0.1*u^2", "u")})},
  };
}

std::vector<NamedProblem> gradient_flow_cases() {
  using enum Boundary;
  return {
      {"Allen_Cahn", allen_cahn({.grid = {.points = {12}, .boundary = {dirichlet}}, .kappa = 0.01, .mobility = 0.25})},
      {"Cahn_Hilliard_2d", cahn_hilliard({.grid = {.points = {5, 4}, .length = {4.0}, .boundary = {neumann, periodic}},
                                          .kappa = 0.5,
                                          .mobility = 0.1,
                                          .low = -0.5,
                                          .high = 1.0,
                                          .mean = 0.2})},
      {"Swift_Hohenberg", swift_hohenberg({.grid = {.points = {16}, .length = {20.0}}, .g = 0.5, .amplitude = 0.4})},
      {"phase_field_crystal_2d",
       phase_field_crystal({.grid = {.points = {5, 4}, .length = {6.0}, .boundary = {periodic, neumann}},
                            .r = 0.25,
                            .mean = -0.25,
                            .amplitude = 0.3,
                            .initial = PatternFormation::Initial::seed})},
  };
}

std::vector<NamedProblem> written_cases() {
  const GridOptions line{.points = {10}, .length = {6.0}};
  const GridOptions chain{.points = {7}, .length = {7.0}, .boundary = {Boundary::dirichlet}};
  return {
      {"written_Henon_Heiles",
       custom_problem(
           {.fields = {"x", "y", "px", "py"},
            .H = "(px^2 + py^2 + x^2 + y^2)/2 + x^2*y - y^3/3",
            .D = {{"0", "0", "0", "0"}, {"0", "0", "0", "0"}, {"0", "0", "0.1", "0"}, {"0", "0", "0", "0.2"}},
            .initial = {{"x", "0.3"}, {"y", "-0.1"}, {"px", "0"}, {"py", "0.2"}}})},
      {"written_pendulum", custom_problem({.parameters = {{"g", 1.0}, {"gamma", 0.2}},
                                           .H = "p^2/2 + g*(1 - cos(q))",
                                           .D = {{"0", "0"}, {"0", "gamma"}},
                                           .initial = {{"q", "1.2"}, {"p", "0"}}})},
      {"written_Toda", custom_problem({.grid = chain,
                                       .H = "v^2/2 + exp(-du) + du - 1 + 0.05*du^2",
                                       .D = {{"0", "0"}, {"0", "0.1 - 0.05*laplacian"}},
                                       .initial = {{"u", "0.3*sin(2*x)"}, {"v", "0"}}})},
      {"written_two_fields",
       custom_problem(
           {.fields = {"u", "w", "p", "r"},
            .grid = line,
            .H = "(p^2 + r^2 + u_x^2)/2 + 0.3*w_x^2 + 0.2*u_x*w_x + 1 - cos(u - w) + "
                 "0.1*(1 + x/6)*u^2*w^2 + sqrt(1 + w^2)",
            .D = {{"0", "0", "0", "0"}, {"0", "0", "0", "0"}, {"0", "0", "0.2", "0"}, {"0", "0", "0", "0.2"}},
            .initial = {{"u", "0.5*sin(x)"}, {"w", "0.3*cos(x)"}, {"p", "0"}, {"r", "0.1"}}})},
      {"written_Kawahara", custom_problem({.fields = {"u"},
                                           .grid = line,
                                           .H = "0.05*u_x^2 + 0.01*u_xx^2 + u^3/6 + u^4/12",
                                           .S = {{"d_x"}},
                                           .D = {{"0.1 + 0.05*sin(t)"}},
                                           .initial = {{"u", "0.4*exp(-(x - 3)^2)"}}})},
      {"NLS_written_in_a_trap", custom_problem({.fields = {"a", "b"},
                                                .grid = line,
                                                .M = {{"-laplacian/2", "0"}, {"0", "-laplacian/2"}},
                                                .V = "0.1*(x - 3)^2*(a^2 + b^2)/2 + (a^2 + b^2)^2/4",
                                                .D = {{"0.1", "0"}, {"0", "0.1"}},
                                                .initial = {{"a", "exp(-(x - 3)^2)"}, {"b", "0.1"}}})},
  };
}

std::vector<NamedProblem> all_cases() {
  std::vector<NamedProblem> cases = golden_cases();
  for (NamedProblem& c : grid_cases()) cases.push_back(std::move(c));
  for (NamedProblem& c : chain_cases()) cases.push_back(std::move(c));
  for (NamedProblem& c : field_rate_cases()) cases.push_back(std::move(c));
  for (NamedProblem& c : matrix_cases()) cases.push_back(std::move(c));
  for (NamedProblem& c : beyond_linear_cases()) cases.push_back(std::move(c));
  for (NamedProblem& c : gradient_flow_cases()) cases.push_back(std::move(c));
  for (NamedProblem& c : written_cases()) cases.push_back(std::move(c));
  cases.push_back({"KG_defocusing", klein_gordon_case(0.1, 1.0)});
  cases.push_back({"gKdV_sigma_1", gkdv_case(0.5, 1.0, 1.0)});
  cases.push_back({"Duffing", duffing_case()});
  const RatePointer varying = formula_rate(compile_formula("0.3 + 0.2*sin(3*t)", {"t"}));
  Problem linear = klein_gordon({.grid = {.points = {16}, .length = {2.0}}, .gamma = varying});
  linear.potential = nullptr;
  cases.push_back({"KG_without_V", linear});
  cases.push_back({"KG_varying_damping", klein_gordon({.alpha = 1.0, .gamma = varying})});
  cases.push_back({"FPU_varying_damping", alpha_fpu({.gamma = varying})});
  cases.push_back({"gKdV_varying_damping", gkdv({.sigma = -0.5, .mu = varying})});
  cases.push_back({"coupled_damping", coupled_damping_case(constant_rate(1.0))});
  cases.push_back({"coupled_varying_damping", coupled_damping_case(varying)});
  return cases;
}

bool applies(std::string_view method, const Problem& problem) {
  const MethodEntry& entry = find_method(method);
  const MethodKind& kind = entry.kind;
  if (problem.structure) return kind.takes_structure;
  const bool needs_momenta = kind.composition == "nystrom" || kind.composition == "chin";
  if (!kind.merges_damping && !needs_momenta) return true;
  try {
    if (needs_momenta)
      make_stepper(entry, find_backend("dense").system(problem, {}));
    else
      with_damping_merged(problem);
    return true;
  } catch (const Error&) {
    return false;
  }
}

std::vector<BackendEntry> backends_for(const Problem& problem) {
  std::vector<BackendEntry> list;
  for (const BackendEntry& entry : backends()) {
    try {
      entry.system(problem, {});
      list.push_back(entry);
    } catch (const Error&) {
    }
  }
  return list;
}

std::vector<BackendEntry> quick_backends_for(const Problem& problem) {
  std::vector<BackendEntry> backends = backends_for(problem);
  std::erase_if(backends, [](const BackendEntry& backend) { return backend.name == "reference"; });
  return backends;
}

}  // namespace seiche::test
