#include <seiche/core/commuting_damping.hpp>
#include <seiche/core/numerics/definiteness.hpp>
#include <seiche/law/operator_findings.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace seiche {
namespace {

using Block = Eigen::MatrixXcd;
using PairBlock = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, 0, 2, 2>;  // not on the heap

template <class AnyBlock>
AnyBlock symbol_of(const BlockStencil& stencil, const Mode& mode) {
  AnyBlock block(stencil.fields(), stencil.fields());
  for (Index i = 0; i < stencil.fields(); ++i)
    for (Index j = 0; j < stencil.fields(); ++j) block(i, j) = stencil(i, j).symbol(mode);
  return block;
}

// The numbers of each process, in their order.
std::vector<double> gathered(const Ranks& ranks, const std::vector<double>& mine) {
  const std::vector<Index> counts(static_cast<std::size_t>(ranks.here().count), std::ssize(mine));
  std::vector<double> all(counts.size() * mine.size());
  ranks.gather(mine, counts, all);
  return all;
}

void write(const Mode& mode, std::vector<double>& to) {
  for (const auto* indices : {&mode.k, &mode.period})
    for (const Index i : *indices) to.push_back(static_cast<double>(i));
}

Mode read_mode(const double* from) {
  Mode mode;
  for (auto* indices : {&mode.k, &mode.period})
    for (Index& i : *indices) i = static_cast<Index>(*from++);
  return mode;
}

// Of all processes: the smallest eigenvalue, its mode and its block, and the largest size. Modes are held in the order
// of processes, so that the first of equal eigenvalues is that of one process.
void take_smallest(const Ranks& ranks, SmallestEigenvalue& found, Block& block) {
  std::vector<double> mine = {found.value, found.size};
  write(found.mode, mine);
  for (const std::complex<double>& entry : block.reshaped()) mine.insert(mine.end(), {entry.real(), entry.imag()});
  const std::vector<double> all = gathered(ranks, mine);
  const double* smallest = all.data();
  for (const double* of = all.data(); of != all.data() + all.size(); of += mine.size()) {
    if (of[0] < smallest[0]) smallest = of;
    found.size = std::max(found.size, of[1]);
  }
  found.value = smallest[0];
  found.mode = read_mode(smallest + 2);
  for (Index i = 0; i < block.size(); ++i) block.reshaped()[i] = {smallest[8 + 2 * i], smallest[9 + 2 * i]};
}

void add_zeros(const Ranks& ranks, SmallestEigenvalue& found) {
  std::vector<double> mine = {static_cast<double>(found.zeros)};
  write(found.first_zero, mine);
  const std::vector<double> all = gathered(ranks, mine);
  found.zeros = 0;
  for (const double* of = all.data(); of != all.data() + all.size(); of += mine.size()) {
    if (found.zeros == 0 && of[0] > 0) found.first_zero = read_mode(of + 1);
    found.zeros += static_cast<Index>(of[0]);
  }
}

// Eigenvalues of Hermitian blocks, mode after mode.
template <class AnyBlock>
class Scan {
 public:
  Scan(Index fields, Index modes) : fields_(fields) { values_.reserve(static_cast<std::size_t>(fields * modes)); }

  // Of the Hermitian part of `a`.
  void add(Index k, const AnyBlock& a) {
    size_ = std::max(size_, a.cwiseAbs().maxCoeff());
    const std::size_t begin = values_.size();
    if (fields_ == 1) {
      values_.push_back(a(0, 0).real());
    } else if (fields_ == 2) {
      // mean ∓ √(half difference² + |off|²); the smaller in size from the determinant, which loses nothing where it
      // vanishes
      const double p = a(0, 0).real(), q = a(1, 1).real();
      const double off = std::norm(0.5 * (a(0, 1) + std::conj(a(1, 0))));
      const double mean = 0.5 * (p + q);
      const double root = std::hypot(0.5 * (p - q), std::sqrt(off));
      const double large = mean + std::copysign(root, mean);
      const double small = large == 0 ? 0.0 : p * (q / large) - off / large;
      values_.push_back(std::min(small, large));
      values_.push_back(std::max(small, large));
    } else {
      const Eigen::SelfAdjointEigenSolver<Block> eigen(Block(0.5 * (a + a.adjoint())), Eigen::EigenvaluesOnly);
      for (const double value : eigen.eigenvalues()) values_.push_back(value);
    }
    if (values_[begin] >= smallest_) return;
    smallest_ = values_[begin];
    at_ = k;
    block_ = a;
  }

  SmallestEigenvalue result(const Modes& modes, const Ranks* ranks) const {
    SmallestEigenvalue found;
    found.value = smallest_;
    found.size = size_;
    if (smallest_ < std::numeric_limits<double>::infinity()) found.mode = modes[at_];
    Block block = block_.size() > 0 ? Block(block_) : Block(Block::Zero(fields_, fields_));
    if (ranks != nullptr) take_smallest(*ranks, found, block);
    found.vector = Eigen::SelfAdjointEigenSolver<Block>(Block(0.5 * (block + block.adjoint()))).eigenvectors().col(0);
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (std::abs(values_[i]) > matrix_round_off * found.size) continue;
      if (found.zeros++ == 0) found.first_zero = modes[static_cast<Index>(i) / fields_];
    }
    if (ranks != nullptr) add_zeros(*ranks, found);
    return found;
  }

 private:
  Index fields_;
  std::vector<double> values_;
  double size_ = 0.0, smallest_ = std::numeric_limits<double>::infinity();
  Index at_ = 0;
  AnyBlock block_;
};

// Is D = D₀ + γP one constant matrix whose flow is that of its parts, in any order? Then one part may make up for the
// other.
bool is_one_damping(const Problem& problem) {
  const LinearDamping& damping = problem.damping;
  return problem.has_constant_damping() && damping.rate && damping.rate->is_constant() && !damping.field_rate &&
         rate_commutes(problem);
}

template <class AnyBlock>
OperatorFindings look_at_modes(const Problem& problem, const Ranks* ranks) {
  const Modes modes(ranks != nullptr ? problem.grid : problem.grid.whole());
  const Index m = problem.field_count();
  const LinearDamping& damping = problem.damping;
  const bool has_constant = problem.has_constant_damping();
  const bool has_rate = damping.rate || damping.field_rate;
  const AnyBlock projector = has_rate ? AnyBlock(rate_symbol(problem)) : AnyBlock();
  const bool together = is_one_damping(problem);
  const BlockStencil constant_part = together ? constant_damping(problem) : damping.constant;

  Scan<AnyBlock> metric(m, modes.count()), structure(m, modes.count());
  Scan<AnyBlock> constant(m, has_constant ? modes.count() : 0), rate(m, has_rate && !together ? modes.count() : 0);
  OperatorFindings findings;
  findings.S_is_skew = true;
  for (Index k = 0; k < modes.count(); ++k) {
    const Mode mode = modes[k];
    const AnyBlock M = symbol_of<AnyBlock>(problem.M, mode);
    const AnyBlock S = symbol_of<AnyBlock>(problem.S, mode);
    metric.add(k, M);
    structure.add(k, -S);
    for (Index i = 0; findings.S_is_skew && i < m; ++i)
      for (Index j = 0; j <= i; ++j) findings.S_is_skew &= S(i, j) + std::conj(S(j, i)) == 0.0;
    if (has_constant) constant.add(k, M * symbol_of<AnyBlock>(constant_part, mode));
    if (has_rate && !together) rate.add(k, M * projector);
  }
  if (ranks != nullptr) {
    double bent = findings.S_is_skew ? 0 : 1;
    ranks->max({&bent, 1});
    findings.S_is_skew = bent == 0;
  }
  findings.M.over_modes = metric.result(modes, ranks);
  findings.minus_S.over_modes = structure.result(modes, ranks);
  if (has_constant) findings.MD_constant = Semidefiniteness{.over_modes = constant.result(modes, ranks)};
  if (has_rate && !together) findings.MD_rate = Semidefiniteness{.over_modes = rate.result(modes, ranks)};
  return findings;
}

OperatorFindings look_at_matrices(const Problem& problem) {
  const SparseOperators& matrices = *problem.matrices;
  const auto look = [](const SparseMatrix& A) { return Semidefiniteness{.negative_direction = negative_direction(A)}; };
  OperatorFindings findings;
  const SparseMatrix symmetric = symmetric_part(matrices.S);
  findings.S_is_skew = symmetric.norm() == 0;
  findings.M = look(matrices.M);
  findings.minus_S = look(SparseMatrix(-symmetric));
  const bool together = is_one_damping(problem);
  if (problem.has_constant_damping())
    findings.MD_constant =
        look(symmetric_part(SparseMatrix(matrices.M * (together ? constant_damping_matrix(problem) : matrices.D))));
  if ((problem.damping.rate || problem.damping.field_rate) && !together)
    findings.MD_rate = look(symmetric_part(matrices.M * rate_matrix(problem)));
  return findings;
}

}  // namespace

bool SmallestEigenvalue::is_nonnegative() const { return value >= -matrix_round_off * size; }

OperatorFindings look_at_operators(const Problem& problem, const Ranks* ranks) {
  if (problem.matrices) return look_at_matrices(problem);
  return problem.field_count() <= 2 ? look_at_modes<PairBlock>(problem, ranks) : look_at_modes<Block>(problem, ranks);
}

}  // namespace seiche
