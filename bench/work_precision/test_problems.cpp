#include <bench/work_precision/test_problems.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/problem/alpha_fpu.hpp>
#include <seiche/problem/common/wave.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/gradient_flow/phase_separation.hpp>
#include <seiche/problem/klein_gordon.hpp>

#include <cmath>
#include <numbers>

namespace seiche::bench {
namespace {

std::vector<double> plain(const Vector& v) { return {v.begin(), v.end()}; }

// u = exp(−|x − centre|²/width²), v = 0
void set_bump(Problem& p, double width) {
  p.initial.setZero();
  for (Index j = 0; j < p.grid.unknowns(); ++j)
    p.initial[j] = std::exp(-squared_distance_from_centre(p.grid, j) / square(width));
}

struct WaveData {
  std::vector<Index> points;
  double dx, alpha, t_end;
  double width = 0;  // of the bump; 0: the paper's data
};

TestProblem klein_gordon_problem(const std::string& key, const std::string& title, const WaveData& data) {
  constexpr double kappa = 0.04, omega_squared = 0.2, gamma = 0.1;
  std::vector<double> length;
  for (const Index n : data.points) length.push_back(data.dx * static_cast<double>(n));
  TestProblem test{.key = key, .title = title};
  test.problem = klein_gordon({.grid = {.points = data.points, .length = length},
                               .kappa = kappa,
                               .omega_squared = omega_squared,
                               .alpha = data.alpha,
                               .gamma = constant_rate(gamma)});
  if (data.width > 0) set_bump(test.problem, data.width);
  const bool line = data.points.size() == 1;
  test.parameters =
      fmt::format("u_tt + {}u_t − {}Δu + {}u {} u³ = 0, {} periodic points, Δx = {}, T = {}, {}", gamma, kappa,
                  omega_squared, data.alpha < 0 ? "−" : "+",
                  line ? fmt::format("{}", data.points[0]) : fmt::format("{} × {}", data.points[0], data.points[1]),
                  data.dx, data.t_end,
                  data.width > 0 ? fmt::format("u₀ = exp(−|x − L/2|²/{}²), v₀ = 0", data.width)
                                 : "the paper’s u₀ and v₀ (a hyperbolic tangent with a jump at the period)");
  test.equation = {.kind = Equation::Kind::klein_gordon,
                   .rows = line ? 1 : static_cast<std::size_t>(data.points[0]),
                   .columns = static_cast<std::size_t>(data.points.back()),
                   .dx = data.dx,
                   .stiffness = kappa,
                   .mass_squared = omega_squared,
                   .strength = data.alpha,
                   .gamma = gamma,
                   .t_end = data.t_end,
                   .initial = plain(test.problem.initial)};
  return test;
}

// The data are odd and smooth about both ends, as the equation keeps them.
TestProblem fpu_problem() {
  constexpr double length = 2.0, epsilon = 0.5, beta = 0.01, gamma = 0.5, t_end = 5.0;
  constexpr Index intervals = 2048;
  TestProblem test{.key = "fpu", .title = "α-FPU, 2047 unknowns per field, stiff Kelvin–Voigt damping"};
  test.problem = alpha_fpu(
      {.length = length, .points = intervals, .epsilon = epsilon, .beta = beta, .gamma = constant_rate(gamma)});
  test.problem.initial.setZero();
  for (Index j = 0; j < test.problem.grid.unknowns(); ++j) {
    const double phase = std::numbers::pi * test.problem.grid.coordinate(j, 0) / length;
    test.problem.initial[j] =
        0.2 * std::sin(phase) * std::exp(-6 * square(std::cos(phase))) + 0.05 * std::sin(2 * phase);
  }
  test.parameters = fmt::format(
      "u_tt − {}u_xxt − (1 + {}u_x)u_xx + u + {}u_t = 0, u = 0 at both ends, {} intervals on [0, {}], T = {}, "
      "u₀ = 0.2 sin(πx/2) exp(−6cos²(πx/2)) + 0.05 sin(πx), v₀ = 0",
      beta, epsilon, gamma, intervals, length, t_end);
  test.equation = {.kind = Equation::Kind::alpha_fpu,
                   .columns = static_cast<std::size_t>(intervals - 1),
                   .dx = length / static_cast<double>(intervals),
                   .stiffness = 1.0,
                   .mass_squared = 1.0,
                   .strength = epsilon,
                   .gamma = gamma,
                   .beta = beta,
                   .t_end = t_end,
                   .initial = plain(test.problem.initial)};
  test.coarsest = 2;
  return test;
}

TestProblem gkdv_problem() {
  constexpr double length = 40.0, sigma = 1.0, mu = 0.1, t_end = 10.0;
  constexpr Index points = 512;
  TestProblem test{.key = "gkdv", .title = "Damped Korteweg–de Vries, 512 points; V is unbounded and no law holds"};
  test.problem = gkdv({.length = length, .points = points, .exponent = 1, .sigma = sigma, .mu = constant_rate(mu)});
  for (Index j = 0; j < points; ++j) {
    double u = 0;
    for (int image = -1; image <= 1; ++image)  // one alone would have a kink where the period ends
      u += 1.5 / square(std::cosh((test.problem.grid.coordinate(j, 0) - length * (0.5 + image)) / 2));
    test.problem.initial[j] = u;
  }
  test.parameters = fmt::format(
      "u_t + u_xxx + ({}u²)_x + {}u = 0 by second-order differences, {} periodic points on [0, {}], T = {}, "
      "u₀ = 1.5 Σ sech²((x − 20 − 40m)/2), m = −1, 0, 1",
      sigma, mu, points, length, t_end);
  test.equation = {.kind = Equation::Kind::gkdv,
                   .columns = static_cast<std::size_t>(points),
                   .dx = length / static_cast<double>(points),
                   .stiffness = 1.0,
                   .strength = sigma,
                   .gamma = mu,
                   .t_end = t_end,
                   .initial = plain(test.problem.initial)};
  test.coarsest = 2;
  return test;
}

TestProblem gradient_flow_problem(const std::string& key) {
  const bool is_conserved = key == "ch2d";
  const Index points = is_conserved ? 64 : 128;
  const double kappa = is_conserved ? 1e-3 : 5e-4, t_end = is_conserved ? 0.0625 : 16.0;
  const PhaseSeparation options{.grid = {.points = {points, points}, .length = {1.0}},
                                .kappa = kappa,
                                .amplitude = is_conserved ? 0.5 : 0.9};
  TestProblem test{.key = key,
                   .title = is_conserved ? "Cahn–Hilliard in the plane, 64 × 64 points, stiff"
                                         : "Allen–Cahn in the plane, 128 × 128 points"};
  test.problem = is_conserved ? cahn_hilliard(options) : allen_cahn(options);
  test.parameters = fmt::format("u_t = {}, κ = {}, {} × {} periodic points on the unit square, T = {}, u₀: waves",
                                is_conserved ? "Δ(u³ − u − κΔu)" : "κΔu + u − u³", kappa, points, points, t_end);
  test.equation = {.kind = is_conserved ? Equation::Kind::cahn_hilliard : Equation::Kind::allen_cahn,
                   .rows = static_cast<std::size_t>(points),
                   .columns = static_cast<std::size_t>(points),
                   .dx = 1 / static_cast<double>(points),
                   .stiffness = kappa,
                   .t_end = t_end,
                   .initial = plain(test.problem.initial)};
  test.coarsest = is_conserved ? 9 : 1;
  if (is_conserved) test.reference_tolerance = 1e-12;
  return test;
}

}  // namespace

std::vector<std::string> test_problem_keys() {
  return {"kg20", "kg4096", "kgs", "kg2d", "fpu", "gkdv", "ac2d", "ch2d"};
}

TestProblem make_test_problem(const std::string& key) {
  if (key == "kg20") {
    return klein_gordon_problem(key, "Klein–Gordon, the paper’s 20 points",
                                {.points = {20}, .dx = 0.1, .alpha = -1, .t_end = 50});
  }
  if (key == "kg4096") {
    return klein_gordon_problem(key, "Klein–Gordon, 4096 points, not stiff",
                                {.points = {4096}, .dx = 0.1, .alpha = 1, .t_end = 50, .width = 5});
  }
  if (key == "kgs") {
    return klein_gordon_problem(key, "Klein–Gordon, 4096 points, stiff",
                                {.points = {4096}, .dx = 0.005, .alpha = 1, .t_end = 50, .width = 1});
  }
  if (key == "kg2d") {
    return klein_gordon_problem(key, "Klein–Gordon in the plane, 256 × 256 points",
                                {.points = {256, 256}, .dx = 0.2, .alpha = 1, .t_end = 20, .width = 4});
  }
  if (key == "fpu") return fpu_problem();
  if (key == "gkdv") return gkdv_problem();
  if (key == "ac2d" || key == "ch2d") return gradient_flow_problem(key);
  throw unknown_name("problem", key, test_problem_keys());
}

}  // namespace seiche::bench
