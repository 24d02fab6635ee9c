#include <seiche/core/commuting_damping.hpp>
#include <seiche/core/numerics/definiteness.hpp>
#include <seiche/law/operator_hypotheses.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

namespace seiche {
namespace {

using Block = Eigen::MatrixXcd;

// Few degrees of freedom have no waves: all of them are one block.
bool has_modes(const Problem& problem) { return !problem.grid.only_numbers; }

std::string text_of(const Mode& mode, const Grid& grid) {
  std::vector<Index> k(mode.k.begin(), mode.k.begin() + grid.dimension());
  return fmt::format("mode k = ({})", fmt::join(k, ", "));
}

// 0.2, or 0.1-0.3i
std::string text_of(std::complex<double> x) {
  constexpr double digits = 5e-4;  // of a vector of norm 1, as they are shown
  if (std::abs(x.imag()) < digits) return fmt::format("{:.3g}", std::abs(x.real()) < digits ? 0.0 : x.real());
  return fmt::format("{:.3g}{:+.3g}i", std::abs(x.real()) < digits ? 0.0 : x.real(), x.imag());
}

// "z = (u: 0.98, v: -0.2)", with a phase that makes the largest component real and positive
std::string text_of(const Problem& problem, const Eigen::VectorXcd& z) {
  Index largest = 0;
  z.cwiseAbs().maxCoeff(&largest);
  const std::complex<double> phase = std::conj(z[largest]) / std::abs(z[largest]);
  std::vector<std::string> components;
  for (Index f = 0; f < problem.field_count(); ++f)
    components.push_back(fmt::format("{}: {}", problem.fields[static_cast<std::size_t>(f)], text_of(phase * z[f])));
  return fmt::format("z = ({})", fmt::join(components, ", "));
}

// "mode k = (3), z = (u: 0.98, v: -0.2), where it is -0.17"
std::string witness(const Problem& problem, const SmallestEigenvalue& s) {
  const std::string mode = has_modes(problem) ? text_of(s.mode, problem.grid) + ", " : "";
  return fmt::format("{}{}, where it is {:.6g}", mode, text_of(problem, s.vector), s.value);
}

std::string witness(const Problem& problem, const NegativeDirection& x) {
  const Index n = problem.grid.unknowns();
  return fmt::format("a z of norm 1, largest at point {} of field {}, where it is {:.6g}", x.largest % n + 1,
                     problem.fields[static_cast<std::size_t>(x.largest / n)], x.value);
}

// Of what should be positive semidefinite.
Hypothesis semidefinite(const Problem& problem, std::string name, const Semidefiniteness& found,
                        const std::string& meaning) {
  if (!found.over_modes) {
    if (const auto& x = found.negative_direction)
      return {std::move(name), Grade::violated, meaning + " fails", x->value, witness(problem, *x)};
    return {std::move(name), Grade::verified, meaning + ", by the signs of the pivots of LDLᵀ"};
  }
  const SmallestEigenvalue& s = *found.over_modes;
  if (!found.holds()) return {std::move(name), Grade::violated, meaning + " fails", s.value, witness(problem, s)};
  std::string text = fmt::format("{}: the smallest eigenvalue{} is {:.6g}", meaning,
                                 has_modes(problem) ? " over all modes" : "", std::max(s.value, 0.0));
  if (s.zeros > 0 && has_modes(problem))
    text += fmt::format("; {} eigenvalues are 0, the first at {}", s.zeros, text_of(s.first_zero, problem.grid));
  else if (s.zeros > 0)  // the smallest of all then is one
    text += fmt::format("; it vanishes on {}", text_of(problem, s.vector));
  return {std::move(name), Grade::verified, std::move(text), std::max(s.value, 0.0)};
}

}  // namespace

Hypothesis hypothesis_of_S(const Problem& problem, const OperatorFindings& findings) {
  const std::string name = "sym(S) ⪯ 0";
  if (findings.S_is_skew)
    return {name, Grade::by_structure,
            problem.matrices     ? "S is skew: Sᵀ = −S entry by entry"
            : has_modes(problem) ? "S is skew: S + Sᴴ = 0 exactly, on every mode"
                                 : "S is skew: S + Sᵀ = 0 exactly"};
  return semidefinite(problem, name, findings.minus_S, "S dissipates: −sym(S) ⪰ 0");
}

Hypothesis hypothesis_of_M(const Problem& problem, const OperatorFindings& findings) {
  return semidefinite(problem, "M ⪰ 0", findings.M, "½zᵀMz ≥ 0");
}

Hypothesis hypothesis_of_MD(const Problem& problem, const OperatorFindings& findings) {
  const std::string name = "sym(MD) ⪰ 0";
  std::vector<Hypothesis> parts;
  if (findings.MD_constant)
    parts.push_back(semidefinite(problem, name, *findings.MD_constant,
                                 findings.MD_rate ? "the constant part of D by itself damps ½zᵀMz"
                                                  : "the constant part of D damps ½zᵀMz"));
  if (findings.MD_rate) parts.push_back(semidefinite(problem, name, *findings.MD_rate, "γ ≥ 0 damps ½zᵀMz"));
  if (parts.empty()) return {name, Grade::by_structure, "there is no linear damping"};
  Hypothesis worst = parts.front();
  for (const Hypothesis& part : parts)
    if (part.grade == Grade::violated) worst = part;
  return worst;
}

Hypothesis hypothesis_of_commuting(const Problem& problem) {
  const std::string name = "D(t)D(s) = D(s)D(t)";
  const LinearDamping& damping = problem.damping;
  if (has_constant_rates(damping)) return {name, Grade::by_structure, "D does not depend on time"};
  if (!problem.has_constant_damping()) return {name, Grade::by_structure, "D(t) is a diagonal matrix, at every time"};
  double largest = 0;
  double size = 0;
  if (problem.matrices) {
    const SparseMatrix P = rate_matrix(problem);
    const SparseMatrix& D = problem.matrices->D;
    largest = SparseMatrix(D * P - P * D).norm();
    size = D.norm();
  } else {
    const Modes modes(problem.grid.whole());
    for (Index k = 0; k < modes.count(); ++k) {
      const Block D = problem.damping.constant.symbol(modes[k]);
      const Block P = rate_symbol(problem);
      largest = std::max(largest, (D * P - P * D).norm());
      size = std::max(size, D.norm());
    }
    if (damping.field_rate) largest = size;  // γ(x, t) and a difference operator do not
  }
  if (largest <= matrix_round_off * size)
    return {name, Grade::verified, "the constant part of D and its rate commute: exp(−∫D) is the exact flow"};
  return {name, Grade::violated,
          "the constant part of D and its rate do not commute: the damping flow is of order two, and each factor of it "
          "still takes energy",
          largest};
}

}  // namespace seiche
