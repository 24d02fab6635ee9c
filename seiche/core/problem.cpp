#include <seiche/core/base/error.hpp>
#include <seiche/core/problem.hpp>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace seiche {
namespace {

constexpr std::string_view methods_that_split =
    "methods that split the damping off (savf, seavf, seisav, seilm, …) and egc2 … egc8 take it";

bool any_entry_in_row(const BlockStencil& a, Index row) {
  for (Index j = 0; j < a.fields(); ++j)
    if (!a(row, j).is_zero()) return true;
  return false;
}

// ∇_vH = v for field v: M acts on it as the identity, alone, and V does not depend on it.
bool gradient_is_identity(const Problem& p, Index field) {
  if (p.potential_depends_on(field)) return false;
  for (Index j = 0; j < p.field_count(); ++j) {
    if (j == field ? !p.M(field, j).is_identity() : !p.M(field, j).is_zero()) return false;
  }
  return true;
}

// The same for matrices: D' has the columns of D divided by the diagonal of M, where a row of M holds nothing else.
Problem with_matrix_merged(const Problem& problem) {
  const SparseOperators& old = *problem.matrices;
  const LinearDamping& damping = problem.damping;
  SparseMatrix D = old.D;
  if (damping.rate) D += damping.rate->value(0) * rate_matrix(problem);
  for (Index column = 0; column < D.outerSize(); ++column) {
    double diagonal = 0;
    bool alone = !problem.potential_depends_on(column / problem.grid.unknowns());
    for (SparseMatrix::InnerIterator entry(old.M, column); entry; ++entry) {
      if (entry.row() == column) diagonal = entry.value();
      if (entry.row() != column && entry.value() != 0) alone = false;
    }
    for (SparseMatrix::InnerIterator entry(D, column); entry; ++entry) {
      if (entry.value() == 0) continue;
      if (!alone || diagonal <= 0)
        throw Error(
            "a method that merges the damping into S needs Dz = D'∇H(z), but in {} ∇H is not a multiple of z at entry "
            "{}, which is damped; methods that split the damping off (savf, seavf, seisav, seilm, …) and egc2 … egc8 take it",
            problem.name, column + 1);
      entry.valueRef() /= diagonal;
    }
  }
  Problem merged = problem;
  merged.matrices = std::make_shared<SparseOperators>(
      SparseOperators{.S = old.S - D, .M = old.M, .D = SparseMatrix(D.rows(), D.cols())});
  merged.damping = LinearDamping{.constant = BlockStencil(problem.field_count())};
  return merged;
}

// At some of the points of a rate on a whole grid.
class RateAtPoints final : public FieldRate {
 public:
  RateAtPoints(FieldRatePointer whole, Index first, Index of) : whole_(std::move(whole)), first_(first), all_(of) {}
  void values(double t, std::span<double> gamma) const override {
    copy(gamma, [&](std::span<double> all) { whole_->values(t, all); });
  }
  void integrals(double t, double h, std::span<double> out) const override {
    copy(out, [&](std::span<double> all) { whole_->integrals(t, h, all); });
  }
  bool is_constant() const override { return whole_->is_constant(); }
  double first_negative_time(double t_end) const override { return whole_->first_negative_time(t_end); }
  double negative_seen() const override { return whole_->negative_seen(); }
  std::string text() const override { return whole_->text(); }

 private:
  template <class Fill>
  void copy(std::span<double> out, const Fill& fill) const {
    std::vector<double> all(static_cast<std::size_t>(all_));
    fill(std::span(all));
    std::copy_n(all.begin() + first_, out.size(), out.begin());
  }

  FieldRatePointer whole_;
  Index first_, all_;
};

}  // namespace

bool Problem::potential_depends_on(Index field) const {
  return potential && field >= potential_field && field < potential_field + potential->fields();
}

bool Problem::has_damping() const { return damping.rate || damping.field_rate || friction || has_constant_damping(); }

bool Problem::has_forces() const {
  return std::any_of(forces.begin(), forces.end(), [](const FieldRatePointer& f) { return f != nullptr; });
}

bool Problem::has_constant_damping() const {
  return matrices ? matrices->D.nonZeros() > 0 : !damping.constant.is_zero();
}

bool Problem::damping_moves(Index field) const {
  if (friction && field >= field_count() / 2) return true;  // momenta
  if ((damping.rate || damping.field_rate) && damping.rate_fields[static_cast<std::size_t>(field)]) return true;
  if (matrices) return matrices->damping_moves(field * grid.unknowns(), grid.unknowns());
  return any_entry_in_row(damping.constant, field);
}

bool Problem::damping_moves_potential() const {
  for (Index field = 0; field < field_count(); ++field)
    if (potential_depends_on(field) && damping_moves(field)) return true;
  return false;
}

Problem with_rates_at_points(const Problem& problem, Index first, Index of) {
  Problem part = problem;
  const auto divide = [&](FieldRatePointer& rate) {
    if (rate) rate = std::make_shared<RateAtPoints>(rate, first, of);
  };
  divide(part.damping.field_rate);
  for (FieldRatePointer& force : part.forces) divide(force);
  if (problem.friction && problem.friction->uses_place())
    throw Error("the friction {} depends on the place, and has to be made for the points of one process",
                problem.friction->text());
  return part;
}

Problem part_of(const Problem& whole, const Rank& here) {
  Problem part = whole;
  part.grid.here = here;
  const Index all = whole.grid.unknowns(), mine = part.grid.unknowns(), first = part.grid.first_unknown();
  part.initial.resize(part.size());
  for (Index f = 0; f < whole.field_count(); ++f)
    part.initial.segment(f * mine, mine) = whole.initial.segment(f * all + first, mine);
  if (whole.potential)
    if (auto there = whole.potential->at_points(first, mine)) part.potential = std::move(there);
  return with_rates_at_points(part, first, all);
}

SparseMatrix rate_matrix(const Problem& problem) {
  SparseMatrix p(problem.size(), problem.size());
  for (Index i = 0; i < problem.size(); ++i)
    if (problem.damping.rate_fields[static_cast<std::size_t>(i / problem.grid.unknowns())]) p.insert(i, i) = 1;
  return p;
}

Eigen::MatrixXcd rate_symbol(const Problem& problem) {
  const Index n = problem.field_count();
  Eigen::MatrixXcd p = Eigen::MatrixXcd::Zero(n, n);
  for (Index i = 0; i < n; ++i) p(i, i) = problem.damping.rate_fields[static_cast<std::size_t>(i)];
  return p;
}

double rate_of_D0(const Problem& problem) {
  double rate = problem.damping.rate ? problem.damping.rate->value(0) : 0.0;
  if (!problem.damping.field_rate) return rate;
  return rate + mean_field_rate(problem);
}

double mean_field_rate(const Problem& problem) {
  if (problem.damping.mean_field_rate) return *problem.damping.mean_field_rate;
  Vector gamma(problem.grid.unknowns());
  problem.damping.field_rate->values(0, {gamma.data(), static_cast<std::size_t>(gamma.size())});
  return gamma.mean();
}

BlockStencil constant_damping(const Problem& problem) {
  BlockStencil D = problem.damping.constant;
  const double rate = rate_of_D0(problem);
  for (Index f = 0; rate != 0 && f < problem.field_count(); ++f)
    if (problem.damping.rate_fields[static_cast<std::size_t>(f)]) D(f, f) += Stencil::identity(rate);
  return D;
}

SparseMatrix constant_damping_matrix(const Problem& problem) {
  const double rate = rate_of_D0(problem);
  if (rate == 0) return problem.matrices->D;
  return problem.matrices->D + rate * rate_matrix(problem);
}

Problem with_damping_merged(const Problem& problem) {
  const LinearDamping& damping = problem.damping;
  if (problem.friction)
    throw Error("a method that merges the damping into S needs a linear damping, but {} has the friction {}; {}",
                problem.name, problem.friction->text(), methods_that_split);
  if (problem.structure)
    throw Error("a method that merges the damping into S needs one matrix S, and in {} it is {}; egc2 … egc8 take it",
                problem.name, problem.structure->text());
  if (problem.has_forces())
    throw Error("a method that merges the damping into S has no place for the external force on {}; {}", problem.name,
                methods_that_split);
  if (!problem.has_damping()) return problem;
  if (damping.field_rate)
    throw Error(
        "a method that merges the damping into S needs a constant D, but the rate {} changes from point to "
        "point; methods that split the damping off (savf, seavf, seisav, seilm, …) and egc2 … egc8 take it",
        damping.field_rate->text());
  if (damping.rate && !damping.rate->is_constant()) {
    throw Error(
        "a method that merges the damping into S needs a constant D, but the rate {} varies with time; "
        "methods that split the damping off (savf, seavf, seisav, seilm, …) and egc2 … egc8 take it",
        damping.rate->text());
  }
  if (problem.matrices) return with_matrix_merged(problem);
  Problem merged = problem;
  const auto merge = [&](Index row, Index column, const Stencil& d) {
    if (d.is_zero()) return;
    if (!gradient_is_identity(problem, column)) {
      throw Error(
          "a method that merges the damping into S needs Dz = D'∇H(z), but in {} the damped field {} has "
          "∇H ≠ {}; methods that split the damping off (savf, seavf, seisav, seilm, …) and egc2 … egc8 take it",
          problem.name, problem.fields[static_cast<std::size_t>(column)],
          problem.fields[static_cast<std::size_t>(column)]);
    }
    merged.S(row, column) += -1.0 * d;
  };
  for (Index i = 0; i < problem.field_count(); ++i) {
    for (Index j = 0; j < problem.field_count(); ++j) merge(i, j, damping.constant(i, j));
    if (damping.rate && damping.rate_fields[static_cast<std::size_t>(i)]) {
      merge(i, i, Stencil::identity(damping.rate->value(0)));
    }
  }
  merged.damping = LinearDamping{.constant = BlockStencil(problem.field_count())};
  return merged;
}

}  // namespace seiche
