// An equation written down: a wall of φ⁴ on a line, its energy H, its damping D and how it starts by formulas. Nothing
// is differentiated by hand; H is split into ½zᵀMz and V, and the first note of the problem says how.
#include <seiche/seiche.hpp>

#include <cstdio>

int main() {
  const auto wall = seiche::custom_problem(
      {.grid = seiche::GridOptions{.points = {128}, .length = {40.0}, .boundary = {seiche::Boundary::neumann}},
       .parameters = {{"c", 0.5}, {"gamma", 0.02}},
       .H = "v^2/2 + u_x^2/2 + (u^2 - 1)^2/4",
       .D = {{"0", "0"}, {"0", "gamma"}},
       .initial = {{"u", "tanh((x - 12)/sqrt(2*(1 - c^2)))"},
                   {"v", "-c/sqrt(2*(1 - c^2))*sech((x - 12)/sqrt(2*(1 - c^2)))^2"}}});
  const auto solution = seiche::solve(wall, {.method = "seisav", .h = 1.0 / 32, .t_end = 30});
  std::printf("%s\n", wall.notes.front().c_str());
  std::printf("%s, energy law %s\n", seiche::to_string(solution.report.status).c_str(),
              seiche::to_string(solution.report.law).c_str());
  std::printf("H falls from %.4f to %.4f\n", solution.H.front(), solution.H.back());
}
// It prints:
//   H = ½zᵀMz + V with ½zᵀMz = v^2/2 + u_x^2/2 and V = (u^2 - 1)^2/4
//   success, energy law holds
//   H falls from 3.4762 to 3.1592
