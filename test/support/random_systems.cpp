#include <test/support/random_systems.hpp>

#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/common/grid_options.hpp>
#include <seiche/problem/common/second_order.hpp>
#include <seiche/problem/common/wave.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace seiche::test {
namespace {

using Matrix = Eigen::MatrixXd;

Matrix normal_matrix(Index rows, Index columns, Random& random) {
  Matrix a(rows, columns);
  for (double& x : a.reshaped()) x = random.normal();
  return a;
}

// Symmetric to the bit, of the size 1, and of any rank.
Matrix semidefinite(Index size, Random& random) {
  const Index rank = random.chance(0.7) ? size : random.whole(1, size);
  const Matrix a = normal_matrix(rank, size, random);
  const Matrix product = a.transpose() * a / static_cast<double>(size);
  return (product + product.transpose()) / 2;
}

Matrix skew(Index size, Random& random) {
  const Matrix a = normal_matrix(size, size, random);
  return (a - a.transpose()) / 2;
}

// Bounded below, but for some; or none at all. `outward`: x·W'(x) ≥ 0.
std::shared_ptr<const PointwisePotential> some_potential(bool outward, Random& random, std::string& text) {
  std::vector<double> c(5, 0.0);
  if (random.chance(0.1)) {
    text += ", V = 0";
    return nullptr;
  }
  if (!outward && random.chance(0.15)) {
    c[3] = random.normal();  // u³ alone
    c.resize(4);
  } else {
    if (!outward) c[3] = random.normal();
    c[4] = random.decades(-1, 0.5);
    if (random.chance(0.3)) {
      c.resize(7, 0.0);
      c[6] = random.decades(-1, 0);
    }
  }
  text += fmt::format(", V of degree {}", c.size() - 1);
  return nodal_polynomial(c);
}

RatePointer some_rate(Random& random, std::string& text) {
  const double gamma = random.decades(-2, 1);
  if (random.chance(0.6)) {
    text += fmt::format(", gamma = {:.3g}", gamma);
    return constant_rate(gamma);
  }
  const std::string formula = fmt::format("{:.17g}*(1 + 0.9*sin({:.3g}*t))", gamma, random.decades(-1, 1));
  text += ", gamma = " + formula;
  return formula_rate(compile_formula(formula, {"t"}));
}

Problem matrix_problem(Index points, std::vector<std::string> fields, const Matrix& S, const Matrix& M,
                       const Matrix& D) {
  const auto count = static_cast<Index>(fields.size());
  Problem p;
  p.name = "random";
  p.grid = points_without_place(points);
  p.fields = std::move(fields);
  p.S = p.M = p.damping.constant = BlockStencil(count);
  p.matrices = std::make_shared<SparseOperators>(SparseOperators{S.sparseView(), M.sparseView(), D.sparseView()});
  p.matrices->validate();
  return p;
}

// Any skew S, perhaps with a part that dissipates, and any M.
void make_full(RandomSystem& s, Random& random) {
  const Index count = random.whole(1, 2), points = random.whole(count == 1 ? 2 : 1, 4), size = count * points;
  Matrix S = random.decades(-1, 1) * skew(size, random);
  const Matrix M = random.decades(-1, 1) * semidefinite(size, random);
  s.text += fmt::format("{} fields of {} points", count, points);
  const bool dissipates = random.chance(0.2);
  if (dissipates) {
    S -= random.decades(-2, 0) * semidefinite(size, random);
    s.text += ", S dissipates";
  }
  Matrix D = Matrix::Zero(size, size);
  // D = RM with R ⪰ 0 takes from ½zᵀMz; where V is, it must not act.
  const bool damped = count == 2 && random.chance(0.5);
  if (damped) {
    Matrix R = Matrix::Zero(size, size);
    R.bottomRightCorner(points, points) = random.decades(-2, 1) * semidefinite(points, random);
    D = R * M;
    s.text += ", D = RM";
  }
  s.problem =
      matrix_problem(points, count == 1 ? std::vector<std::string>{"u"} : std::vector<std::string>{"u", "v"}, S, M, D);
  const bool all_damped = !damped && random.chance(0.3);
  s.problem.potential = some_potential(all_damped, random, s.text);
  if (all_damped) {
    s.problem.damping.rate = some_rate(random, s.text);
    s.problem.damping.rate_fields.assign(static_cast<std::size_t>(count), true);
  }
  s.keeps_H = !dissipates && !damped && !all_damped;
}

// q̇ = p, ṗ = −Kq − ∇V(q) − Dp, with masses that need not be 1.
void make_mechanical(RandomSystem& s, Random& random) {
  const Index points = random.whole(1, 4), size = 2 * points;
  Matrix S = Matrix::Zero(size, size), M = S, D = S;
  S.topRightCorner(points, points).setIdentity();
  S.bottomLeftCorner(points, points) = -Matrix::Identity(points, points);
  M.topLeftCorner(points, points) = random.decades(-2, 2) * semidefinite(points, random);
  const double inverse_mass = random.chance(0.5) ? 1.0 : random.decades(-1, 1);
  M.bottomRightCorner(points, points) = inverse_mass * Matrix::Identity(points, points);
  s.text += fmt::format("{} masses", points);
  const bool dashpots = random.chance(0.4), rate = random.chance(0.5);
  if (dashpots) {
    D.bottomRightCorner(points, points) = random.decades(-2, 1) * semidefinite(points, random);
    s.text += ", dashpots";
  }
  s.problem = matrix_problem(points, {"q", "p"}, S, M, D);
  if (rate) {
    s.problem.damping.rate = some_rate(random, s.text);
    s.problem.damping.rate_fields = {false, true};
  }
  s.problem.potential = some_potential(false, random, s.text);
  s.keeps_H = !dashpots && !rate;
}

// Waves on a line, and equations of first order u_t = ∂(δH/δu) on a ring.
void make_grid_problem(RandomSystem& s, Random& random) {
  const bool waves = random.chance(0.6);
  const Boundary boundary = waves ? static_cast<Boundary>(random.whole(0, 2)) : Boundary::periodic;
  const Index points = random.whole(4, 9);
  const Grid grid = make_grid({.points = {points}, .length = {random.decades(-0.3, 1)}, .boundary = {boundary}});
  const auto discretisation = random.chance(0.7) ? Discretisation::fd2 : Discretisation::spectral;
  const Stencil R = Stencil::laplacian(grid, discretisation);
  const double a = random.chance(0.3) ? 0.0 : random.decades(-1, 1), b = random.decades(-2, 0);
  s.text += fmt::format("{} on {} points, {}", waves ? "waves" : "first order", points,
                        discretisation == Discretisation::fd2 ? "fd2" : "spectral");
  bool damped = false;
  if (waves) {
    damped = random.chance(0.6);
    s.problem = wave_problem("random", grid, Stencil::identity(a) + -b * R,
                             damped ? DampingRate(some_rate(random, s.text)) : DampingRate(nullptr));
    if (random.chance(0.3)) {
      s.problem.damping.constant(1, 1) = -random.decades(-3, -1) * R;
      s.text += ", viscous";
      damped = true;
    }
  } else {
    damped = random.chance(0.4);
    s.problem.name = "random";
    s.problem.grid = grid;
    s.problem.fields = {"u"};
    s.problem.S = s.problem.M = BlockStencil(1);
    s.problem.S(0, 0) = Stencil::derivative(grid, 0, discretisation);
    s.problem.M(0, 0) = Stencil::identity(a) + -b * R;
    s.problem.damping =
        rate_damping(damped ? DampingRate(some_rate(random, s.text)) : DampingRate(nullptr), grid, {true});
    s.problem.damping.constant = BlockStencil(1);
  }
  s.problem.potential = some_potential(!waves && damped, random, s.text);
  s.keeps_H = !damped;
}

}  // namespace

double Random::decades(double least, double most) { return std::pow(10.0, between(least, most)); }

RandomSystem random_system(std::uint64_t seed) {
  Random random(seed);
  RandomSystem s;
  s.text = fmt::format("seed {}: ", seed);
  switch (seed % 3) {
    case 0: make_full(s, random); break;
    case 1: make_mechanical(s, random); break;
    default: make_grid_problem(s, random);
  }
  s.h = random.decades(-4, 2);
  s.text += fmt::format(", h = {:.4g}", s.h);
  const double amplitude = random.decades(-2, 0.7);
  s.problem.initial.resize(s.problem.size());
  for (double& x : s.problem.initial) x = amplitude * random.normal();
  return s;
}

Problem nearby(const Problem& problem, double size, Random& random) {
  // Entries (i, j) and (j, i) by the same factor.
  const auto moved = [&](const SparseMatrix& a) {
    SparseMatrix factors = a;
    for (double& x : factors.coeffs()) x = 1 + size * random.normal();
    SparseMatrix result = a;
    for (Index column = 0; column < a.outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(result, column); entry; ++entry) {
        const double factor = factors.coeff(std::max(entry.row(), column), std::min(entry.row(), column));
        if (factor != 0) entry.valueRef() *= factor;
      }
    return result;
  };
  Problem p = problem;
  for (double& x : p.initial) x *= 1 + size * random.normal();
  if (p.matrices) {
    SparseOperators matrices = *p.matrices;
    matrices.S = moved(matrices.S);
    matrices.D = moved(matrices.D);
    matrices.M *= 1 + size * random.normal();
    p.matrices = std::make_shared<SparseOperators>(std::move(matrices));
  }
  return p;
}

}  // namespace seiche::test
