// A potential and a law of friction by functions of one's own, on a wave: V = Σ(cosh u − 1), which `gradient_complaint`
// compares with its gradient, and a drag R(v) = c|v|v with its exact flow.
#include <seiche/seiche.hpp>

#include <cmath>
#include <cstdio>
#include <span>

int main() {
  const seiche::OwnPotential cosh = {.value =
                                         [](std::span<const double> u) {
                                           double sum = 0;
                                           for (const double x : u) sum += std::cosh(x) - 1;
                                           return sum;
                                         },
                                     .gradient =
                                         [](std::span<const double> u, std::span<double> gradient) {
                                           for (std::size_t j = 0; j < u.size(); ++j) gradient[j] = std::sinh(u[j]);
                                         },
                                     .grows_outward = true};  // u·∇V ≥ 0: asked for where damping moves u
  constexpr double c = 0.3;
  const seiche::OwnFriction drag = {.force =
                                        [](double, std::span<const double>, std::span<const double> v,
                                           std::span<double> r) {
                                          for (std::size_t j = 0; j < v.size(); ++j) r[j] = c * std::abs(v[j]) * v[j];
                                        },
                                    .flow =  // of v̇ = −wR(v) over h, in place; w = 1 where momenta are velocities
                                    [](double, double h, double w, std::span<const double>, std::span<double> v) {
                                      for (double& x : v) x /= 1 + w * c * h * std::abs(x);
                                    },
                                    .text = "0.3|v|v"};

  auto problem = seiche::klein_gordon({.grid = {.points = {32}}, .alpha = 0.0, .gamma = seiche::constant_rate(0)});
  const std::span<const double> u(problem.initial.data(), 32);
  if (const std::string complaint = seiche::gradient_complaint(cosh, u); !complaint.empty()) {
    std::printf("%s\n", complaint.c_str());
    return 1;
  }
  problem.potential = seiche::own_potential(cosh);
  problem.friction = seiche::own_friction(drag);
  const auto solution = seiche::solve(problem, {.method = "seavf", .h = 0.05, .t_end = 20});
  std::printf("%s, energy law %s\n", seiche::to_string(solution.report.status).c_str(),
              seiche::to_string(solution.report.law).c_str());
  std::printf("H falls from %.4f to %.4f\n", solution.H.front(), solution.H.back());
}
// It prints:
//   success, energy law holds
//   H falls from 4.7747 to 0.6103
