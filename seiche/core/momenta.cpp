#include <seiche/core/momenta.hpp>

namespace seiche {
namespace {

std::optional<Momenta> momenta_of_stencils(const Problem& problem) {
  const Index m = problem.field_count() / 2;
  const auto is = [](const Stencil& a, double factor) { return a.factor_of_identity() == factor; };
  const std::optional<double> w = problem.M(m, m).factor_of_identity();
  if (!w || *w <= 0) return std::nullopt;
  for (Index i = 0; i < m; ++i) {
    for (Index j = 0; j < m; ++j) {
      const double unit = i == j ? 1 : 0;
      if (!is(problem.S(i, j), 0) || !is(problem.S(m + i, m + j), 0) || !is(problem.S(i, m + j), unit) ||
          !is(problem.S(m + i, j), -unit) || !is(problem.M(m + i, m + j), unit * *w) || !is(problem.M(i, m + j), 0) ||
          !is(problem.M(m + i, j), 0))
        return std::nullopt;
    }
  }
  return Momenta{.first = m, .count = m, .inverse_mass = *w};
}

std::optional<Momenta> momenta_of_matrices(const Problem& problem) {
  const Index n = problem.size() / 2;
  const Index m = problem.field_count() / 2;
  const double w = problem.matrices->M.coeff(n, n);
  if (w <= 0) return std::nullopt;
  bool fits = true;
  Index ones = 0;
  for_entries(problem.matrices->S, [&](Index i, Index j, double value) {
    if (value == 0) return;
    fits = fits && ((j == i + n && value == 1) || (i == j + n && value == -1));
    ++ones;
  });
  Index masses = 0;
  for_entries(problem.matrices->M, [&](Index i, Index j, double value) {
    if (value == 0 || (i < n && j < n)) return;
    fits = fits && i == j && value == w;
    ++masses;
  });
  if (!fits || ones != 2 * n || masses != n) return std::nullopt;
  return Momenta{.first = m, .count = m, .inverse_mass = w};
}

}  // namespace

std::optional<Momenta> momenta(const Problem& problem) {
  if (problem.field_count() == 0 || problem.field_count() % 2 != 0 || problem.structure) return std::nullopt;
  for (Index p = problem.field_count() / 2; p < problem.field_count(); ++p)
    if (problem.potential_depends_on(p)) return std::nullopt;
  return problem.matrices ? momenta_of_matrices(problem) : momenta_of_stencils(problem);
}

}  // namespace seiche
