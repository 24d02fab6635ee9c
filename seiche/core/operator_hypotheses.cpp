#include <seiche/core/definiteness.hpp>
#include <seiche/core/operator_hypotheses.hpp>

#include <fmt/ranges.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace seiche {
namespace {

using Block = Eigen::MatrixXcd;
using Symbol = std::function<Block(const Mode&)>;

constexpr double round_off = 1e-13;  // relative to the largest entry

// The smallest eigenvalue of a Hermitian symbol over all modes, and whose it is.
struct Smallest {
  double value = std::numeric_limits<double>::infinity();
  double size = 0;          // the largest entry
  Mode mode = {};           // of the smallest eigenvalue
  Eigen::VectorXcd vector;  // its eigenvector, over the fields
  Index zeros = 0;          // eigenvalues that vanish
  Mode first_zero = {};

  bool is_nonnegative() const { return value >= -round_off * size; }
};

Smallest smallest_eigenvalue(const Grid& grid, const Symbol& symbol) {
  Smallest s;
  const Modes modes(grid);
  for (Index k = 0; k < modes.count(); ++k) s.size = std::max(s.size, symbol(modes[k]).cwiseAbs().maxCoeff());
  for (Index k = 0; k < modes.count(); ++k) {
    const Block a = symbol(modes[k]);
    const Eigen::SelfAdjointEigenSolver<Block> eigen(0.5 * (a + a.adjoint()));
    for (const double value : eigen.eigenvalues()) {
      if (std::abs(value) > round_off * s.size) continue;
      if (s.zeros++ == 0) s.first_zero = modes[k];
    }
    if (eigen.eigenvalues()[0] >= s.value) continue;
    s.value = eigen.eigenvalues()[0];
    s.mode = modes[k];
    s.vector = eigen.eigenvectors().col(0);
  }
  return s;
}

std::string text_of(const Mode& mode, const Grid& grid) {
  std::vector<Index> k(mode.k.begin(), mode.k.begin() + grid.dimension());
  return fmt::format("mode k = ({})", fmt::join(k, ", "));
}

// "mode k = (3), z = (u: 0.98, v: 0.2)"
std::string witness(const Problem& problem, const Smallest& s) {
  std::string text = text_of(s.mode, problem.grid) + ", |z| = (";
  for (Index f = 0; f < problem.field_count(); ++f)
    text += fmt::format("{}{}: {:.3g}", f > 0 ? ", " : "", problem.fields[static_cast<std::size_t>(f)],
                        std::abs(s.vector[f]));
  return text + fmt::format("), where it is {:.6g}", s.value);
}

std::string witness(const Problem& problem, const NegativeDirection& x) {
  const Index n = problem.grid.unknowns();
  return fmt::format("a z of norm 1, largest at point {} of field {}, where it is {:.6g}", x.largest % n + 1,
                     problem.fields[static_cast<std::size_t>(x.largest / n)], x.value);
}

// Of a matrix that should be positive semidefinite.
Hypothesis semidefinite(const Problem& problem, std::string name, const SparseMatrix& A, const std::string& meaning) {
  const auto x = negative_direction(A);
  if (x) return {std::move(name), Grade::violated, meaning + " fails", x->value, witness(problem, *x)};
  return {std::move(name), Grade::verified, meaning + ", by the signs of the pivots of LDLᵀ"};
}

Hypothesis semidefinite(const Problem& problem, std::string name, const Symbol& symbol, const std::string& meaning) {
  const Smallest s = smallest_eigenvalue(problem.grid, symbol);
  if (!s.is_nonnegative()) return {std::move(name), Grade::violated, meaning + " fails", s.value, witness(problem, s)};
  std::string text =
      fmt::format("{}: the smallest eigenvalue over all modes is {:.6g}", meaning, std::max(s.value, 0.0));
  if (s.zeros > 0) text += fmt::format("; {} vanish, the first at {}", s.zeros, text_of(s.first_zero, problem.grid));
  return {std::move(name), Grade::verified, std::move(text), std::max(s.value, 0.0)};
}

bool has_rate(const Problem& problem) { return problem.damping.rate || problem.damping.field_rate; }

}  // namespace

Hypothesis hypothesis_of_S(const Problem& problem) {
  const std::string name = "sym(S) ⪯ 0";
  if (problem.matrices) {
    const SparseMatrix symmetric = symmetric_part(problem.matrices->S);
    if (symmetric.norm() == 0) return {name, Grade::by_structure, "S is skew: Sᵀ = −S entry by entry"};
    return semidefinite(problem, name, SparseMatrix(-symmetric), "S dissipates: −sym(S) ⪰ 0");
  }
  const Symbol minus_twice_sym = [&](const Mode& mode) -> Block {
    const Block S = problem.S.symbol(mode);
    return -(S + S.adjoint());
  };
  const Modes modes(problem.grid);
  bool skew = true;
  for (Index k = 0; k < modes.count(); ++k) skew = skew && minus_twice_sym(modes[k]).isZero(0);
  if (skew) return {name, Grade::by_structure, "S is skew: S + Sᴴ = 0 exactly, on every mode"};
  return semidefinite(problem, name, minus_twice_sym, "S dissipates: −(S + Sᴴ) ⪰ 0");
}

Hypothesis hypothesis_of_M(const Problem& problem) {
  if (problem.matrices) return semidefinite(problem, "M ⪰ 0", problem.matrices->M, "½zᵀMz ≥ 0");
  return semidefinite(
      problem, "M ⪰ 0", [&](const Mode& mode) { return problem.M.symbol(mode); }, "½zᵀMz ≥ 0");
}

Hypothesis hypothesis_of_MD(const Problem& problem) {
  const std::string name = "sym(MD) ⪰ 0";
  std::vector<Hypothesis> parts;
  if (problem.matrices) {
    const SparseMatrix& M = problem.matrices->M;
    if (problem.has_constant_damping())
      parts.push_back(semidefinite(problem, name, symmetric_part(M * problem.matrices->D),
                                   "the constant part of D takes from ½zᵀMz"));
    if (has_rate(problem))
      parts.push_back(semidefinite(problem, name, symmetric_part(M * rate_matrix(problem)),
                                   "the rate takes from ½zᵀMz where it is ≥ 0"));
  } else {
    if (problem.has_constant_damping())
      parts.push_back(semidefinite(
          problem, name,
          [&](const Mode& mode) -> Block { return problem.M.symbol(mode) * problem.damping.constant.symbol(mode); },
          "the constant part of D takes from ½zᵀMz"));
    if (has_rate(problem))
      parts.push_back(semidefinite(
          problem, name, [&](const Mode& mode) -> Block { return problem.M.symbol(mode) * rate_symbol(problem); },
          "the rate takes from ½zᵀMz where it is ≥ 0"));
  }
  if (parts.empty()) return {name, Grade::by_structure, "there is no linear damping"};
  Hypothesis worst = parts.front();
  for (const Hypothesis& part : parts)
    if (part.grade == Grade::violated) worst = part;
  return worst;
}

Hypothesis hypothesis_of_commuting(const Problem& problem) {
  const std::string name = "D(t)D(s) = D(s)D(t)";
  const LinearDamping& damping = problem.damping;
  const bool constant_rate =
      (!damping.rate || damping.rate->is_constant()) && (!damping.field_rate || damping.field_rate->is_constant());
  if (constant_rate) return {name, Grade::by_structure, "D does not depend on time"};
  if (!problem.has_constant_damping()) return {name, Grade::by_structure, "D(t) is a diagonal matrix, at every time"};
  double largest = 0;
  double size = 0;
  if (problem.matrices) {
    const SparseMatrix P = rate_matrix(problem);
    const SparseMatrix& D = problem.matrices->D;
    largest = SparseMatrix(D * P - P * D).norm();
    size = D.norm();
  } else {
    const Modes modes(problem.grid);
    for (Index k = 0; k < modes.count(); ++k) {
      const Block D = problem.damping.constant.symbol(modes[k]);
      const Block P = rate_symbol(problem);
      largest = std::max(largest, (D * P - P * D).norm());
      size = std::max(size, D.norm());
    }
    if (damping.field_rate) largest = size;  // γ(x, t) and a difference operator do not
  }
  if (largest <= round_off * size)
    return {name, Grade::verified, "the constant part of D and its rate commute: exp(−∫D) is the exact flow"};
  return {name, Grade::violated,
          "the constant part of D and its rate do not commute: the damping flow is of order two, and each factor of it "
          "still takes energy",
          largest};
}

}  // namespace seiche
