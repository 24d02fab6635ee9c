// Any system ż = S∇H(z) − Dz with H = ½zᵀMz + ¼Σu⁴: five masses between walls, one of them with a dashpot.
// S is [[0, I], [−I, 0]] unless it is given; M must be symmetric and sym(S) ⪯ 0, which is checked.
#include <seiche/seiche.hpp>

#include <cstdio>

int main() {
  const int n = 5;
  seiche::SparseOperators matrices;
  matrices.M.resize(2 * n, 2 * n);
  matrices.D.resize(2 * n, 2 * n);
  for (int i = 0; i < n; ++i) {
    matrices.M.insert(i, i) = 2;  // springs
    if (i > 0) matrices.M.insert(i, i - 1) = matrices.M.insert(i - 1, i) = -1;
    matrices.M.insert(n + i, n + i) = 1;  // masses
  }
  matrices.D.insert(n + 2, n + 2) = 0.5;  // the dashpot, on the momentum of the third mass
  auto problem = seiche::sparse_problem({.fields = 2, .matrices = std::move(matrices), .quartic = 1.0});
  problem.initial.setZero();
  problem.initial[0] = 1;
  const auto solution = seiche::solve(problem, {.method = "egc4", .h = 0.125, .t_end = 40});
  std::printf("on the %s backend, energy law %s\n", solution.backend.c_str(),
              seiche::to_string(solution.report.law).c_str());
  std::printf("H falls from %.4f to %.4f\n", solution.H.front(), solution.H.back());
}
// It prints:
//   on the dense backend, energy law holds
//   H falls from 1.2500 to 0.5891
