#include <seiche/core/error.hpp>
#include <seiche/core/law.hpp>
#include <seiche/core/law_matrices.hpp>
#include <seiche/core/law_of_damping.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace seiche {
namespace {

constexpr double round_off = 1e-13;  // relative to the size of the symbol

struct Extreme {
  double smallest;
  double largest;
  double size;
  bool is_nonnegative() const { return smallest >= -round_off * size; }
  bool is_nonpositive() const { return largest <= round_off * size; }
};

// Extreme eigenvalues over all modes of the Hermitian part of a symbol.
template <class Symbol>
Extreme hermitian_extremes(const Grid& grid, const Symbol& symbol) {
  Extreme extreme{0, 0, 0};
  const Modes modes(grid);
  for (Index k = 0; k < modes.count(); ++k) {
    const Eigen::MatrixXcd a = symbol(modes[k]);
    const Eigen::MatrixXcd hermitian = 0.5 * (a + a.adjoint());
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(hermitian, Eigen::EigenvaluesOnly).eigenvalues();
    extreme.smallest = std::min(extreme.smallest, values.minCoeff());
    extreme.largest = std::max(extreme.largest, values.maxCoeff());
    extreme.size = std::max(extreme.size, a.cwiseAbs().maxCoeff());
  }
  return extreme;
}

// "t = 1, x = 0.5, y = 2" where the rate is smallest at time t.
std::string place_of_smallest(const FieldRate& rate, const Grid& grid, double t) {
  std::vector<double> gamma(static_cast<std::size_t>(grid.unknowns()));
  rate.values(t, gamma);
  const auto point = std::min_element(gamma.begin(), gamma.end()) - gamma.begin();
  std::string text = fmt::format("t = {:.6g}", t);
  for (Index a = 0; a < grid.dimension(); ++a)
    text += fmt::format(", {} = {:.6g}", "xyz"[a], grid.coordinate(point, a));
  return text;
}

// What stands against sym(MD) ⪰ 0 for D = γ(x, t)P, or "". The symbol of γ(x, t) has no modes: the sign of MD is known
// where M is a multiple of the identity on the damped fields, and there only.
std::string complaint_about_field_rate(const Problem& problem, double t_end) {
  const FieldRate& rate = *problem.damping.field_rate;
  const double t_bad = rate.first_negative_time(t_end);
  if (t_bad >= 0)
    return fmt::format("the rate {} is negative at {}", rate.text(), place_of_smallest(rate, problem.grid, t_bad));
  for (Index i = 0; i < problem.field_count(); ++i) {
    if (!problem.damping.rate_fields[static_cast<std::size_t>(i)]) continue;
    for (Index j = 0; j < problem.field_count(); ++j) {
      if (i == j ? problem.M(i, i).factor_of_identity().has_value() : problem.M(i, j).is_zero()) continue;
      return fmt::format(
          "the rate {} changes from point to point and M is not a multiple of the identity on the damped field {}: "
          "sym(MD) ⪰ 0 is not guaranteed",
          rate.text(), problem.fields[static_cast<std::size_t>(i)]);
    }
  }
  if (problem.damping_moves_potential()) return "the rate changes from point to point and moves what V depends on";
  return "";
}

LawPromise promise_of_stencils(const Problem& problem, double t_end) {
  const auto m = [&](const Mode& mode) { return problem.M.symbol(mode); };
  const Extreme metric = hermitian_extremes(problem.grid, m);
  if (!metric.is_nonnegative()) {
    return {false, fmt::format("M is not positive semidefinite (eigenvalue {:.3g})", metric.smallest)};
  }
  const Extreme structure = hermitian_extremes(problem.grid, [&](const Mode& mode) { return problem.S.symbol(mode); });
  if (!structure.is_nonpositive()) {
    return {false, fmt::format("sym(S) is not negative semidefinite (eigenvalue {:.3g})", structure.largest)};
  }
  const LinearDamping& damping = problem.damping;
  if (!problem.has_damping()) return {true, "sym(S) ⪯ 0 and no damping flow"};

  if (const std::string complaint = complaint_about_rate(damping.rate.get(), t_end); !complaint.empty())
    return {false, complaint};
  if (damping.field_rate) {
    const std::string complaint = complaint_about_field_rate(problem, t_end);
    if (!complaint.empty()) return {false, complaint};
  }
  const Extreme constant = hermitian_extremes(problem.grid, [&](const Mode& mode) -> Eigen::MatrixXcd {
    return problem.M.symbol(mode) * problem.damping.constant.symbol(mode);
  });
  Extreme varying{0, 0, 0};
  if (damping.rate) {
    varying = hermitian_extremes(problem.grid, [&](const Mode& mode) -> Eigen::MatrixXcd {
      return problem.M.symbol(mode) * rate_symbol(problem);
    });
  }
  if (!constant.is_nonnegative() || !varying.is_nonnegative()) {
    return {false, "sym(MD) is not positive semidefinite: the damping feeds some mode"};
  }
  return promise_given_semidefinite_MD(problem);
}

}  // namespace

LawPromise promise_energy_law(const Problem& problem, double t_end) {
  if (const std::string complaint = complaint_beyond_linear(problem, t_end); !complaint.empty())
    return {false, complaint};
  return problem.matrices ? promise_energy_law_of_matrices(problem, t_end) : promise_of_stencils(problem, t_end);
}

}  // namespace seiche
